// test_device.c: compares the OpenGL device with the CPU device beyond the demonstration scenes: the three stages, all
// outputs, exponents up to 1000, more lights than fit in a uniform block, pictures in parts, several samples, limits.
#include "card.h"
#include "context.h"
#include "device_or_skip.h"
#include "scenes.h"
#include "share.h"

#include <lambent/light.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static lam_device *cpu;

static void build(const char *name, struct demo *demo)
{
    lam_error error = {0};
    if (!demo_build_named(name, demo, &error))
        fail_msg("%s", error.text);
}

static lam_image draw(lam_device *device, const struct demo *demo, const lam_draw_params *params,
                      lam_pixel_format format)
{
    lam_error error = {0};
    lam_image image = {0};
    if (!lam_image_make(&image, demo->width, demo->height, format, &error) ||
        !lam_draw(device, demo->scene, &demo->camera, params, &image, NULL, &error))
        fail_msg("%s: %s", lam_device_name(device), error.text);
    return image;
}

// Difference between the two devices: fraction of pixels that differ by more than 1/255, and largest difference in floats.
struct apart {
    double share, floats;
};

static struct apart compare(lam_device *gl, const struct demo *demo, const lam_draw_params *params)
{
    struct apart out = {0};
    lam_image a = draw(cpu, demo, params, LAM_RGBA8), b = draw(gl, demo, params, LAM_RGBA8);
    lam_difference difference;
    lam_error error = {0};
    assert_true(lam_image_compare(&a, &b, &difference, &error));
    out.share = difference.share_over_1;
    lam_image_free(&a);
    lam_image_free(&b);
    a = draw(cpu, demo, params, LAM_RGBA32F);
    b = draw(gl, demo, params, LAM_RGBA32F);
    const float *p = a.pixels, *q = b.pixels;
    for (size_t i = 0; i < 4 * (size_t)demo->width * (size_t)demo->height; i++) {
        double d = (double)p[i] - (double)q[i], size = (double)p[i] > 1 ? (double)p[i] : 1;
        d = (d < 0 ? -d : d) / size;
        out.floats = d > out.floats ? d : out.floats;
    }
    lam_image_free(&a);
    lam_image_free(&b);
    return out;
}

// Every shading method and stage with every reflection model: all combinations in two scenes (a third of them without
// LAMBENT_LONG), and a different sixth of them in each of the others.
static void test_stages(void **state)
{
    static const struct {
        lam_shading shading;
        lam_stage stage;
    } ways[] = {{LAM_SHADING_FLAT, LAM_STAGE_APPLICATION}, {LAM_SHADING_FLAT, LAM_STAGE_VERTEX},
                {LAM_SHADING_FLAT, LAM_STAGE_FRAGMENT},    {LAM_SHADING_GOURAUD, LAM_STAGE_APPLICATION},
                {LAM_SHADING_GOURAUD, LAM_STAGE_VERTEX},   {LAM_SHADING_PHONG, LAM_STAGE_FRAGMENT}};
    static const char *const names[] = {"lights",         "translucent-sides", "two-sides-mirrored",
                                        "vertex-colours", "triangle-colours",  "mirror-gouraud"};
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_CORE);
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        struct demo demo;
        build(names[n], &demo);
        lam_draw_params params = demo.params;
        params.samples = 1;
        double worst = 0;
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
            for (int model = LAM_REFLECTION_NONE; model < LAM_REFLECTION_COUNT; model++)
                for (int gl1 = 0; gl1 < 2; gl1++) {
                    size_t number = w + n + (size_t)model;
                    if (n > 1 ? number % 6 != 0 : !is_taken(number + (size_t)gl1, 3))
                        continue;
                    params.shading = ways[w].shading;
                    params.stage = ways[w].stage;
                    params.reflection = (lam_reflection)model;
                    params.gl1 = gl1;
                    double share = compare(gl, &demo, &params).share;
                    worst = share > worst ? share : worst;
                    if (share > 0.001)
                        fail_msg("%s: shading %d, stage %d, model %d, gl1 %d: %g of the pixels differ by "
                                 "more than 1/255",
                                 names[n], params.shading, params.stage, model, gl1, share);
                }
        print_message("%-20s at most %.4f %% over 1/255\n", names[n], 100 * worst);
        lam_scene_free(demo.scene);
    }
    lam_device_free(gl);
}

// Tangents along the normals have no direction on the surface (conventions, rule 10), on both devices and in every
// stage. Rounding leaves a different direction at every point of a tilted square.
static void test_tangents_along_normals(void **state)
{
    static const float corners[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    static const float normals[4][3] = {{0.1f, 0.2f, 1}, {-0.3f, 0.1f, 1}, {0.2f, -0.1f, 1}, {-0.1f, -0.3f, 1}};
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_CORE);
    lam_error error = {0};
    float tangents[4][4];
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 4; c++)
            tangents[i][c] = c < 3 ? 0.7f * normals[i][c] : 1;
    lam_mesh mesh = {.positions = corners[0],
                     .indices = indices,
                     .vertex_count = 4,
                     .triangle_count = 2,
                     .normals = normals[0],
                     .normal_count = 4,
                     .tangents = tangents[0],
                     .tangent_count = 4};
    struct demo demo = {.scene = lam_scene_make(NULL), .width = 64, .height = 64};
    lam_object object = lam_object_default();
    lam_mat4 turn = {{{0.8, 0.36, -0.48, 0.1}, {0, 0.8, 0.6, 0.2}, {0.6, -0.48, 0.64, 0.3}, {0, 0, 0, 1}}};
    object.transform = turn;
    object.mesh = lam_scene_add_mesh(demo.scene, &mesh, &error);
    if (object.mesh < 0 || lam_scene_add_object(demo.scene, &object, &error) < 0)
        fail_msg("%s", error.text);
    demo.camera = lam_camera_fit(demo.scene, demo.width, demo.height, NULL);
    for (int stage = LAM_STAGE_APPLICATION; stage <= LAM_STAGE_FRAGMENT; stage++)
        for (int model = LAM_REFLECTION_KAJIYA_KAY; model <= LAM_REFLECTION_KAJIYA_KAY_LECTURE; model++)
            for (int output = 0; output < 3; output++) {
                static const lam_output outputs[] = {LAM_OUTPUT_PICTURE, LAM_OUTPUT_DIFFUSE, LAM_OUTPUT_SPECULAR};
                lam_draw_params params = {.samples = 1,
                                          .rig = LAM_RIG_HEADLIGHT,
                                          .stage = (lam_stage)stage,
                                          .shading =
                                              stage == LAM_STAGE_FRAGMENT ? LAM_SHADING_PHONG : LAM_SHADING_GOURAUD,
                                          .reflection = (lam_reflection)model,
                                          .output = outputs[output]};
                lam_image image = draw(gl, &demo, &params, LAM_RGBA32F);
                const float *middle = (const float *)image.pixels + 4 * (32 * 64 + 32);
                assert_true(middle[3] > 0.999f && middle[0] == 0);
                lam_image_free(&image);
                struct apart apart = compare(gl, &demo, &params);
                assert_true(apart.share == 0 && apart.floats < 1e-5);
            }
    lam_scene_free(demo.scene);
    lam_device_free(gl);
}

// Every output: with each shading method in an opaque scene, and in a translucent scene.
static void test_shows(void **state)
{
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_ES);
    static const char *const names[] = {"lights", "translucent", "textured", "textured-classic"};
    for (int n = 0; n < 4; n++) {
        struct demo demo;
        build(names[n], &demo);
        lam_draw_params params = demo.params;
        params.samples = 1;
        params.background = (lam_rgba){1, 0.5f, 0, 0.4f}; // visible in 8 bits in pixels without a triangle
        for (int show = 0; show < LAM_OUTPUT_COUNT; show++)
            for (int shading = 0; shading <= (n ? 0 : LAM_SHADING_FLAT); shading++) {
                params.output = (lam_output)show;
                params.shading = (lam_shading)shading;
                double share = compare(gl, &demo, &params).share;
                if (share > 0.001)
                    fail_msg("%s, %s: shading %d: %g of the pixels differ by more than 1/255", names[n],
                             lam_output_name(params.output), shading, share);
            }
        lam_scene_free(demo.scene);
    }
    lam_device_free(gl);
}

// The exponent multiplies rounding errors by up to 1000.
static void test_sharp_highlights(void **state)
{
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_CORE);
    struct demo demo;
    build("inside", &demo); // no silhouette, so all pixels are compared
    lam_error error = {0};
    for (int shininess = 1; shininess <= 1000; shininess *= 10)
        for (int model = LAM_REFLECTION_NONE; model < LAM_REFLECTION_COUNT; model++) {
            if (!lam_reflection_describe((lam_reflection)model)->base)
                continue;
            lam_material m = lam_material_default();
            m.specular = (lam_rgb){1, 1, 1};
            m.shininess = (float)shininess;
            for (int i = 0; i < lam_scene_material_count(demo.scene); i++)
                assert_true(lam_scene_set_material(demo.scene, i, &m, &error));
            lam_draw_params params = demo.params;
            params.samples = 1;
            params.occlusion = LAM_OCCLUSION_OFF;
            params.reflection = (lam_reflection)model;
            struct apart apart = compare(gl, &demo, &params);
            print_message("shininess %4d, model %d: %.1e\n", shininess, model, apart.floats);
            assert_true(apart.floats <= (is_card(lam_device_name(gl)) ? 1e-2 : 5e-4));
        }
    lam_scene_free(demo.scene);
    lam_device_free(gl);
}

// More lights than fit in a uniform block; textures store them.
static void test_many_lights(void **state)
{
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_CORE);
    struct demo demo;
    build("lights", &demo);
    demo.width = 96;
    demo.height = 72;
    lam_error error = {0};
    for (int i = 0; i < 2500; i++) {
        lam_light l = lam_light_default(i % 3 ? LAM_LIGHT_POINT : LAM_LIGHT_SPOT);
        l.position = (lam_vec3){(i % 50) * 0.16 - 4, 1 + i % 7 * 0.2, (double)i / 50 * 0.16 - 4};
        l.direction = (lam_vec3){0, -1, 0};
        l.cutoff_rad = i % 3 ? 0 : 0.8f;
        l.exponent = 2;
        l.attenuation = (lam_attenuation){1, 0, (float)(i % 5)};
        float c = 0.0005f * (float)(1 + i % 4);
        l.diffuse = l.specular = (lam_rgb){c, 0.7f * c, 0.5f * c};
        assert_true(lam_scene_add_light(demo.scene, &l, &error) >= 0);
    }
    for (int gouraud = 0; gouraud < 2; gouraud++) {
        lam_draw_params params = demo.params;
        params.samples = 1;
        params.shading = gouraud ? LAM_SHADING_GOURAUD : LAM_SHADING_PHONG;
        struct apart apart = compare(gl, &demo, &params);
        print_message("2506 lights: %.4f %% over 1/255, %.1e in floats\n", 100 * apart.share, apart.floats);
        assert_true(apart.share <= 0.001);
    }
    lam_scene_free(demo.scene);
    lam_device_free(gl);
}

static void test_parts_and_samples(void **state)
{
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_ES);
    struct demo demo;
    build("translucent", &demo);
    demo.width = 2100;
    demo.height = 90;
    lam_draw_params params = demo.params;
    params.samples = 1;
    assert_true(compare(gl, &demo, &params).share <= 0.001);
    demo.width = 160;
    demo.height = 120;
    // OpenGL lights each sample, and the CPU each triangle in a pixel, so colours differ slightly; coverage does not.
    for (int samples = 2; samples <= 16; samples *= 2) {
        params.samples = samples;
        params.output = LAM_OUTPUT_COVERAGE;
        assert_true(compare(gl, &demo, &params).share <= 0.001);
        params.output = LAM_OUTPUT_PICTURE;
        assert_true(compare(gl, &demo, &params).share <= 0.02);
    }
    lam_scene_free(demo.scene);
    lam_device_free(gl);
}

// A new scene at the address of a freed one is a different scene.
static void test_scene_after_scene(void **state)
{
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_CORE);
    static const char *const names[] = {"teapot", "cone", "cylinder", "sphere-flat", "teapot", "knot-phong"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        struct demo demo;
        build(names[n], &demo);
        lam_draw_params params = demo.params;
        params.samples = 1;
        assert_true(compare(gl, &demo, &params).share <= 0.001);
        lam_scene_free(demo.scene);
    }
    lam_device_free(gl);
}

static void test_limits(void **state)
{
    (void)state;
    lam_device *gl = device_or_skip(LAM_GL_CORE);
    struct demo demo;
    build("teapot", &demo);
    lam_image image = {0};
    lam_error error = {0};
    assert_true(lam_image_make(&image, demo.width, demo.height, LAM_RGBA8, &error));
    lam_control control = {.memory_limit_bytes = 100000};
    assert_false(lam_draw(gl, demo.scene, &demo.camera, NULL, &image, &control, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    lam_cancel cancel = {1};
    control = (lam_control){.cancel = &cancel};
    assert_false(lam_draw(gl, demo.scene, &demo.camera, NULL, &image, &control, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_true(lam_draw(gl, demo.scene, &demo.camera, NULL, &image, NULL, &error)); // the device still works
    assert_null(lam_explain(gl, demo.scene, &demo.camera, NULL, 16, 16, LAM_RGBA8, 1, 1, NULL, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    lam_image_free(&image);
    lam_scene_free(demo.scene);
    lam_device_free(gl);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stages),
        cmocka_unit_test(test_tangents_along_normals),
        cmocka_unit_test(test_shows),
        cmocka_unit_test(test_sharp_highlights),
        cmocka_unit_test(test_many_lights),
        cmocka_unit_test(test_parts_and_samples),
        cmocka_unit_test(test_scene_after_scene),
        cmocka_unit_test(test_limits),
    };
    lam_error error = {0};
    cpu = lam_device_cpu(NULL, &error);
    int failed = cmocka_run_group_tests_name("gl-device", tests, NULL, NULL);
    lam_device_free(cpu);
    return failed;
}
