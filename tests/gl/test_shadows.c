// test_shadows.c: the shadow data that the OpenGL device keeps from frame to frame: a picture always equals the first
// picture of a new device.
#include "device_or_skip.h"
#include "scenes.h"

#include <lambent/light.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static lam_error error;

static bool try_draw(lam_device *device, const struct demo *demo, uint64_t memory_limit, lam_image *image)
{
    lam_control control = {.memory_limit_bytes = memory_limit};
    *image = (lam_image){0};
    assert_true(lam_image_make(image, demo->width, demo->height, LAM_RGBA8, &error));
    if (lam_draw(device, demo->scene, &demo->camera, &demo->params, image, &control, &error))
        return true;
    lam_image_free(image);
    return false;
}

static lam_image draw(lam_device *device, const struct demo *demo)
{
    lam_image image;
    if (!try_draw(device, demo, 0, &image))
        fail_msg("%s", error.text);
    return image;
}

static bool same_picture(const lam_image *a, const lam_image *b)
{
    lam_difference difference;
    assert_true(lam_image_compare(a, b, &difference, &error));
    return difference.maximum == 0;
}

// A device that has drawn another scene before each of its pictures, so it keeps nothing of them.
static lam_image draw_anew(lam_device *device, const struct demo *demo)
{
    struct demo other = {.width = 8, .height = 8, .params = demo->params};
    other.scene = lam_scene_make(&error);
    assert_non_null(other.scene);
    other.camera = demo->camera;
    lam_image image = draw(device, &other);
    lam_image_free(&image);
    lam_scene_free(other.scene);
    return draw(device, demo);
}

static void add_object(lam_scene *scene, const char *shape, int detail, double x, double y, double z, double size)
{
    lam_shape_params params = {.slices = detail, .stacks = detail};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, shape, &params, &error);
    const double where[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        object.transform.m[i][i] = size;
        object.transform.m[i][3] = where[i];
    }
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
}

// A large ball, on which other objects cast their shadows.
static struct demo ball(void)
{
    struct demo demo = {.width = 64, .height = 64, .params = {.samples = 1, .shadows = true}};
    demo.scene = lam_scene_make(&error);
    assert_non_null(demo.scene);
    add_object(demo.scene, "sphere", 24, 0, 0, 0, 1);
    demo.camera = lam_camera_fit(demo.scene, demo.width, demo.height, NULL);
    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    light.direction = (lam_vec3){-0.3, -0.5, -1};
    assert_true(lam_scene_add_light(demo.scene, &light, &error) >= 0);
    return demo;
}

// If memory is insufficient for a frame's upload, the old shadows stay in the texture; the next frame uploads its own,
// although nothing has moved since the hierarchy was built.
static void a_failed_upload_leaves_no_shadow(void **state)
{
    (void)state;
    enum { DETAIL = 100, TRIANGLES = 2 * DETAIL * DETAIL };
    static const uint64_t limits[] = {350, 450}; // bytes for each triangle
    lam_device *other = device_or_skip(LAM_GL_CORE);
    int failed_later = 0;
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        lam_device *device = device_or_skip(LAM_GL_CORE);
        struct demo demo = ball();
        lam_image without = draw(device, &demo), unused;
        add_object(demo.scene, "sphere", DETAIL, 0.4, 0.5, 1.1, 0.3);
        bool drawn = try_draw(device, &demo, limits[i] * TRIANGLES, &unused);
        if (drawn)
            lam_image_free(&unused);
        else
            assert_int_equal(error.code, LAM_LIMIT);
        lam_image with = draw(device, &demo), expected = draw_anew(other, &demo);
        lam_frame_report report;
        lam_device_report(device, &report);
        failed_later += !drawn && report.hierarchy_ms == 0; // it was built in the failed frame
        assert_true(same_picture(&with, &expected));
        assert_false(same_picture(&with, &without));
        lam_image_free(&without);
        lam_image_free(&with);
        lam_image_free(&expected);
        lam_scene_free(demo.scene);
        lam_device_free(device);
    }
    assert_true(failed_later > 0);
    lam_device_free(other);
}

struct devices {
    lam_device *kept, *other;
    lam_image before;
};

// Draws a changed scene with both devices, and once more without a change.
static void check_change(struct devices *d, const struct demo *demo, const char *change)
{
    lam_image kept = draw(d->kept, demo), expected = draw_anew(d->other, demo);
    lam_frame_report report;
    lam_device_report(d->kept, &report);
    if (!same_picture(&kept, &expected) || same_picture(&kept, &d->before) || !report.bytes_uploaded)
        fail_msg("%s: %d %d %d", change, same_picture(&kept, &expected), same_picture(&kept, &d->before),
                 (int)report.bytes_uploaded);
    lam_image again = draw(d->kept, demo);
    lam_device_report(d->kept, &report);
    assert_int_equal(report.bytes_uploaded, 0);
    assert_true(same_picture(&again, &expected));
    lam_image_free(&d->before);
    lam_image_free(&again);
    lam_image_free(&expected);
    d->before = kept;
}

// Surfaces that transmit light are uploaded again after a change, and not otherwise.
static void surfaces_are_sent_when_they_change(void **state)
{
    (void)state;
    struct devices d = {.kept = device_or_skip(LAM_GL_CORE), .other = device_or_skip(LAM_GL_CORE)};
    struct demo demo;
    assert_true(demo_build_named("shadows-leaves", &demo, &error));
    demo.width = 40;
    demo.height = 30;
    demo.params.samples = 1;
    d.before = draw(d.kept, &demo);
    bool masked = false, blended = false;
    for (int i = 0; i < lam_scene_material_count(demo.scene); i++) {
        lam_material material = *lam_scene_material(demo.scene, i);
        const lam_texture_map *old =
            material.maps[LAM_MAP_OPACITY] ? material.maps[LAM_MAP_OPACITY] : material.maps[LAM_MAP_DIFFUSE];
        if (!old || !old->texture || material.alpha_mode == LAM_ALPHA_OPAQUE)
            continue;
        masked |= material.alpha_mode == LAM_ALPHA_MASK;
        blended |= material.alpha_mode == LAM_ALPHA_BLEND;
        lam_texture_map map = *old;
        map.scale = 0.8F;
        map.channel = 3;
        material.alpha_cutoff = 0.3F;
        material.maps[LAM_MAP_OPACITY] = &map;
        assert_true(lam_scene_set_material(demo.scene, i, &material, &error));
        check_change(&d, &demo, "a map's scale");
        material.diffuse.a = 0.6F;
        material.alpha_cutoff = 0.5F;
        assert_true(lam_scene_set_material(demo.scene, i, &material, &error));
        check_change(&d, &demo, "opacity");
        // Red is 1 everywhere; blue and green are not.
        uint8_t bytes[16] = {255, 255, 0, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 255, 0, 255};
        lam_image picture = {.width = 2, .height = 2, .format = LAM_RGBA8, .stride = 8, .pixels = bytes};
        map = (lam_texture_map){.texture = lam_texture_make(&picture, LAM_TEXTURE_NUMBERS, NULL, &error)};
        assert_non_null(map.texture);
        assert_true(lam_scene_set_material(demo.scene, i, &material, &error));
        lam_texture_free((lam_texture *)(uintptr_t)map.texture); // the scene owns it now
        check_change(&d, &demo, "another picture");
        map.channel = 1;
        assert_true(lam_scene_set_material(demo.scene, i, &material, &error));
        check_change(&d, &demo, "a channel");
        map.channel = 2;
        assert_true(lam_scene_set_material(demo.scene, i, &material, &error));
        check_change(&d, &demo, "another channel");
    }
    assert_true(masked && blended);
    lam_image_free(&d.before);
    lam_scene_free(demo.scene);
    lam_device_free(d.kept);
    lam_device_free(d.other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failed_upload_leaves_no_shadow),
        cmocka_unit_test(surfaces_are_sent_when_they_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
