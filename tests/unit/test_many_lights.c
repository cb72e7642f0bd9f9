// test_many_lights.c: lights omitted in a part of the picture: lights without contribution change no bit, lights with a
// small contribution change the picture by at most the cutoff, and the selection does not depend on the machine.

#include "test.h"
#include "../lighting/random.h"

enum { WIDTH = 150, HEIGHT = 100, CHANNELS = WIDTH * HEIGHT * 4 };

static lam_image draw_with(lam_isa isa, int threads, const lam_scene *scene, const lam_draw_params *params,
                           lam_pixel_format format, lam_frame_report *report)
{
    lam_error error = {0};
    lam_image image = {0};
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){0.4, 0.9, 3.4};
    camera.target = (lam_vec3){0, 0, 0};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = threads, .isa = isa}, &error);
    if (!device || !lam_image_make(&image, WIDTH, HEIGHT, format, &error) ||
        !lam_draw(device, scene, &camera, params, &image, NULL, &error))
        fail_msg("%s", error.text);
    lam_device_report(device, report);
    lam_device_free(device);
    return image;
}

static lam_image draw(const lam_scene *scene, const lam_draw_params *params, lam_pixel_format format,
                      lam_frame_report *report)
{
    return draw_with(LAM_ISA_AUTO, 2, scene, params, format, report);
}

// A knot over a floor, with different materials; `clear`: the knot is translucent.
static lam_scene *make_scene(bool clear)
{
    lam_scene *scene = lam_scene_make(NULL);
    lam_material materials[2] = {lam_material_default(), lam_material_default()};
    materials[0].shininess = 20;
    materials[0].diffuse.a = clear ? 0.5f : 1;
    materials[1].diffuse = (lam_rgba){0.3f, 0.6f, 0.9f, 1};
    materials[1].specular = (lam_rgb){0, 0, 0};
    static const char *const shapes[] = {"torus-knot", "plane"};
    for (int i = 0; i < 2; i++) {
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_shape(scene, shapes[i], &(lam_shape_params){.slices = 60, .stacks = 12}, NULL);
        object.material = lam_scene_add_material(scene, &materials[i], NULL);
        if (i == 1)
            object.transform.m[1][3] = -0.8, object.transform.m[0][0] = 2;
        assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    }
    return scene;
}

static lam_vec3 somewhere(struct random *r, double reach)
{
    float x = random_between(r, -1, 1), y = random_between(r, -1, 1), z = random_between(r, -1, 1);
    return (lam_vec3){reach * (double)x, reach * (double)y, reach * (double)z};
}

// Any kind of light, with any attenuation.
static lam_light any_light(struct random *r)
{
    static const lam_light_type types[] = {LAM_LIGHT_POINT, LAM_LIGHT_POINT, LAM_LIGHT_SPOT, LAM_LIGHT_SPOT,
                                           LAM_LIGHT_DIRECTIONAL};
    lam_light light = lam_light_default(types[random_bits(r) % 5]);
    light.position = somewhere(r, 2.5);
    light.direction = somewhere(r, 1);
    light.direction.y -= 0.1;
    float strength = random_between(r, 0.1f, 0.6f);
    light.diffuse = (lam_rgb){strength, strength * random_between(r, 0, 1), strength};
    light.specular = light.diffuse;
    if (random_bits(r) & 1)
        light.attenuation =
            (lam_attenuation){random_between(r, 0, 1), random_between(r, 0, 1), random_between(r, 0.01f, 1)};
    if (random_bits(r) & 1)
        light.range = random_between(r, 0.3f, 3);
    if (light.type == LAM_LIGHT_SPOT && random_bits(r) & 1) {
        light.outer_rad = random_between(r, 0.1f, 1.5f);
        light.inner_rad = light.outer_rad * random_between(r, 0, 0.9f);
    } else if (light.type == LAM_LIGHT_SPOT) {
        light.cutoff_rad = random_bits(r) & 1 ? random_between(r, 0.1f, 1.57f) : 0;
        light.exponent = random_between(r, 0, 20);
    }
    return light;
}

// The picture of four lights, few enough to be evaluated everywhere, has the same bits among so many black lights that
// lists are made: no contributing light was omitted, and the order of the sum did not change.
TEST(test_exact)
{
    struct random r = {3};
    uint64_t asked = 0, all = 0;
    for (int round = 0; round < 60; round++) {
        AUTO_SCENE scene = make_scene(round % 5 == 4);
        for (int i = 0; i < 4; i++)
            assert_true(lam_scene_add_light(scene, &(lam_light[]){any_light(&r)}[0], NULL) >= 0);
        lam_draw_params params = {.samples = round & 1 ? 4 : 1,
                                  .rig = LAM_RIG_NONE,
                                  .shading = (lam_shading)(round % 4 == 3 ? 1 + round / 4 % 2 : 0),
                                  .reflection = (lam_reflection)(round % LAM_REFLECTION_COUNT),
                                  .gl1 = round % 6 == 5};
        lam_frame_report report;
        AUTO_IMAGE few = draw(scene, &params, LAM_RGBA32F, &report);
        for (int i = 0; i < 30; i++) {
            lam_light black = any_light(&r);
            black.diffuse = black.specular = (lam_rgb){0, 0, 0};
            assert_true(lam_scene_add_light(scene, &black, NULL) >= 0);
        }
        AUTO_IMAGE many = draw(scene, &params, LAM_RGBA32F, &report);
        const float *a = few.pixels, *b = many.pixels;
        for (int i = 0; i < CHANNELS; i++)
            if (memcmp(&a[i], &b[i], 4) != 0)
                fail_msg("round %d: pixel %d,%d channel %d is %.9g among black lights, %.9g without them", round,
                         i / 4 % WIDTH, i / 4 / WIDTH, i % 4, (double)b[i], (double)a[i]);
        asked += report.lights_evaluated;
        all += report.points_lit * 34;
    }
    assert_true(asked * 10 < all); // at most 4 of 34 remain, and some of these are behind the surface
}

// 400 lights, with a range (`ranged`) or without.
static lam_scene *make_many(bool ranged, bool clear)
{
    lam_scene *scene = make_scene(clear);
    struct random r = {11};
    for (int i = 0; i < 400; i++) {
        lam_light light = i % 3 ? lam_light_default(LAM_LIGHT_POINT) : any_light(&r);
        light.position = somewhere(&r, ranged ? 1.5 : 12);
        light.range = ranged ? 0.6f : 0;
        light.attenuation = (lam_attenuation){1, 0, ranged ? 10.0f : 40.0f};
        float s = ranged ? 0.5f : 1;
        light.diffuse = light.specular = (lam_rgb){s * random_between(&r, 0, 1), s * random_between(&r, 0, 1), s};
        if (light.type == LAM_LIGHT_DIRECTIONAL)
            light.diffuse = light.specular = (lam_rgb){1e-6f, 1e-6f, 1e-6f};
        assert_true(lam_scene_add_light(scene, &light, NULL) >= 0);
    }
    return scene;
}

static int largest_byte_difference(const lam_image *a, const lam_image *b)
{
    int most = 0;
    for (int i = 0; i < CHANNELS; i++) {
        int apart = abs(((const uint8_t *)a->pixels)[i] - ((const uint8_t *)b->pixels)[i]);
        most = apart > most ? apart : most;
    }
    return most;
}

// By default, no byte differs by more than 1, and far fewer lights are evaluated.
TEST(test_default)
{
    for (int way = 0; way < 8; way++) {
        AUTO_SCENE scene = make_many(way & 1, way & 2);
        lam_draw_params params = {.rig = LAM_RIG_NONE, .color = way & 4 ? LAM_COLOR_RAW : LAM_COLOR_SRGB};
        lam_frame_report some, all;
        AUTO_IMAGE picture = draw(scene, &params, LAM_RGBA8, &some);
        params.light_cutoff = -1;
        AUTO_IMAGE whole = draw(scene, &params, LAM_RGBA8, &all);
        assert_in_range(largest_byte_difference(&picture, &whole), 0, 1);
        assert_true(all.points_lit == some.points_lit && all.lights_evaluated <= all.points_lit * 400);
        assert_true(some.lights_evaluated < all.lights_evaluated);
        if (way & 1)
            assert_true(some.lights_evaluated * 4 < some.points_lit * 400);
    }
}

// Linear pictures: the difference stays below the cutoff, with any cutoff, exposure and method; a larger cutoff saves
// more. Terms use the same lights, and still add up.
TEST(test_bound)
{
    static const float cutoffs[] = {-1, 0.001f, 0.05f, 0.5f};
    for (int way = 0; way < 6; way++) {
        AUTO_SCENE scene = make_many(way & 1, false);
        lam_draw_params params = {.rig = LAM_RIG_NONE,
                                  .samples = 1,
                                  .color = LAM_COLOR_RAW,
                                  .exposure = way < 2 ? 0 : 1.5,
                                  .shading = (lam_shading)(way / 2),
                                  .reflection = way & 1 ? LAM_REFLECTION_PHONG : LAM_REFLECTION_BLINN_PHONG};
        uint64_t before = UINT64_MAX;
        lam_image whole = {0};
        for (int c = 0; c < 4; c++) {
            lam_frame_report report;
            params.light_cutoff = cutoffs[c];
            lam_image picture = draw(scene, &params, LAM_RGBA32F, &report);
            assert_true(report.lights_evaluated < before);
            before = report.lights_evaluated;
            if (c == 0) {
                whole = picture;
                continue;
            }
            float sums[CHANNELS] = {0};
            double most = 0;
            for (int i = 0; i < CHANNELS; i++)
                most = fmax(
                    most, fabs((double)((const float *)picture.pixels)[i] - (double)((const float *)whole.pixels)[i]));
            if (!(most > 0 && most <= (double)cutoffs[c] + 1e-5))
                fail_msg("way %d: with a cutoff of %g the picture is off by %g", way, (double)cutoffs[c], most);
            for (int show = LAM_OUTPUT_AMBIENT; show <= LAM_OUTPUT_REFLECTION; show++) {
                params.output = (lam_output)show;
                AUTO_IMAGE term = draw(scene, &params, LAM_RGBA32F, &report);
                for (int i = 0; i < CHANNELS; i++)
                    sums[i] += ((const float *)term.pixels)[i];
            }
            params.output = LAM_OUTPUT_PICTURE;
            for (int i = 0; i < CHANNELS; i++)
                if (i % 4 != 3)
                    assert_true(fabs((double)sums[i] - (double)((const float *)picture.pixels)[i]) < 2e-5);
            lam_image_free(&picture);
        }
        lam_image_free(&whole);
    }
}

// The bytes are the same with every instruction set and number of threads, also with many layers over one another.
TEST(test_same_everywhere)
{
    for (int way = 0; way < 6; way++) {
        AUTO_SCENE scene = make_many(way & 1, way & 2);
        lam_draw_params params = {.rig = LAM_RIG_NONE, .light_cutoff = 0.02f, .samples = way & 2 ? 16 : 4};
        params.shading = way >= 4 ? LAM_SHADING_GOURAUD : LAM_SHADING_PHONG;
        lam_frame_report first, other;
        AUTO_IMAGE expected = draw_with(LAM_ISA_SCALAR, 1, scene, &params, LAM_RGBA8, &first);
        for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
            for (int threads = 1; threads <= 3 && lam_isa_usable((lam_isa)isa); threads++) {
                AUTO_IMAGE picture = draw_with((lam_isa)isa, threads, scene, &params, LAM_RGBA8, &other);
                assert_memory_equal(picture.pixels, expected.pixels, CHANNELS);
                assert_int_equal(first.lights_evaluated, other.lights_evaluated);
            }
    }
}

// An explained pixel equals the picture's; its lights state which are omitted, and the others add up.
TEST(test_explained)
{
    lam_error error = {0};
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){0.4, 0.9, 3.4};
    camera.target = (lam_vec3){0, 0, 0};
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    int left_out = 0, reported = 0;
    for (int way = 0; way < 6; way++) {
        AUTO_SCENE scene = make_many(way & 1, way == 5);
        lam_draw_params params = {.rig = LAM_RIG_NONE, .samples = way < 3 ? 1 : 4, .light_cutoff = 0.05f};
        params.shading = (lam_shading)(way % 3);
        lam_frame_report report;
        AUTO_IMAGE picture = draw(scene, &params, LAM_RGBA8, &report);
        for (int at = 0; at < WIDTH * HEIGHT; at += 1487) {
            lam_explanation *e = lam_explain(device, scene, &camera, &params, WIDTH, HEIGHT, LAM_RGBA8, at % WIDTH,
                                             at / WIDTH, NULL, &error);
            SUCCEEDS(e);
            assert_memory_equal(e->bytes, (const uint8_t *)picture.pixels + 4 * at, 4);
            for (int f = 0; f < e->fragment_count; f++)
                for (int p = 0; p < e->fragments[f].point_count; p++) {
                    const lam_explained_point *point = &e->fragments[f].points[p];
                    float sum = 0;
                    assert_int_equal(point->light_count, 400);
                    for (int i = 0; i < point->light_count; i++) {
                        left_out += point->lights[i].skipped;
                        sum += point->lights[i].skipped ? 0 : point->lights[i].diffuse_term.b;
                    }
                    assert_true(fabsf(sum * point->color.b - point->diffuse.b) < 1e-5f);
                    reported++;
                }
            lam_explanation_free(e);
        }
    }
    assert_true(reported > 20 && left_out > 100);
}

TEST(test_refused)
{
    AUTO_SCENE scene = make_scene(false);
    AUTO_DEVICE device = lam_device_null(NULL);
    lam_camera camera = lam_camera_default();
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, 8, 8, LAM_RGBA8, NULL));
    const float bad[] = {1.5f, NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 4; i++) {
        lam_error error = {0};
        assert_false(
            lam_draw(device, scene, &camera, &(lam_draw_params){.light_cutoff = bad[i]}, &image, NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, "light_cutoff"));
    }
}
