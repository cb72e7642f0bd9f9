// test_ground.c: the ground plane under a scene: its height, its shadow, contact, and cases without it.
#include "test.h"
#include "device_fixture.h"

#include <lambent/explain.h>

enum { SIZE = 128 };

static lam_error error;

static void add(lam_scene *scene, const char *shape, lam_vec3 scale, lam_vec3 at)
{
    lam_material m = lam_material_default();
    m.emission = (lam_rgb){1, 1, 1}; // distinguishes the model from the ground, which is black
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_shape(scene, shape, NULL, &error);
    o.material = lam_scene_add_material(scene, &m, &error);
    o.transform.m[0][0] = scale.x;
    o.transform.m[1][1] = scale.y;
    o.transform.m[2][2] = scale.z;
    o.transform.m[0][3] = at.x;
    o.transform.m[1][3] = at.y;
    o.transform.m[2][3] = at.z;
    if (lam_scene_add_object(scene, &o, &error) < 0)
        fail_msg("%s", error.text);
}

static lam_image draw(const lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    return draw_square(scene, camera, &params, SIZE);
}

static const float *at(const lam_image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * ((size_t)y * SIZE + (size_t)x);
}

static lam_vec3 minus(lam_vec3 a, lam_vec3 b) { return (lam_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static lam_vec3 plus(lam_vec3 a, lam_vec3 b, double s)
{
    return (lam_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static lam_vec3 cross(lam_vec3 a, lam_vec3 b)
{
    return (lam_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static lam_vec3 unit(lam_vec3 a)
{
    double l = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    return (lam_vec3){a.x / l, a.y / l, a.z / l};
}

// The intersection of the ray through the middle of a pixel with the plane y = `height`.
static lam_vec3 on_plane(const lam_camera *c, int px, int py, double height)
{
    lam_vec3 forward = unit(minus(c->target, c->eye)), right = unit(cross(forward, c->up)), up = cross(right, forward);
    double half = c->ortho_half_height > 0 ? c->ortho_half_height : tan(c->fovy_rad / 2);
    double x = (2 * (px + 0.5) / SIZE - 1) * half, y = (1 - 2 * (py + 0.5) / SIZE) * half;
    lam_vec3 from = c->eye, along = forward;
    if (c->ortho_half_height > 0)
        from = plus(plus(from, right, x), up, y);
    else
        along = plus(plus(along, right, x), up, y);
    return plus(from, along, (height - from.y) / along.y);
}

// A square of side 2 is at height 1 above the ground, whose height a small ball determines. The sun's light falls at
// 45°, so the shadow is the square moved by 1. Ambient light is half of the sun's light on a perpendicular face.
static void check_shadow(const lam_camera *camera, lam_rgb color)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    add(scene, "plane", (lam_vec3){1, 1, 1}, (lam_vec3){0, 1, 0});
    add(scene, "sphere", (lam_vec3){0.01, 0.01, 0.01}, (lam_vec3){0, 0.01, 0});
    lam_light sun = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    sun.direction = (lam_vec3){1, -1, 0};
    sun.diffuse = color;
    lam_scene_add_light(scene, &sun, &error);
    lam_scene_set_ambient(scene, (lam_rgb){0.5f, 0.5f, 0.5f});
    AUTO_IMAGE image = draw(scene, camera, (lam_draw_params){.ground = LAM_GROUND_SHADOW, .samples = 1});
    lam_frame_report report;
    lam_device_report(device, &report);
    assert_true(report.ground && fabs(report.ground_height) < 2e-3 && report.ground_square == 0);
    double y = 0.2126 * (double)color.r + 0.7152 * (double)color.g + 0.0722 * (double)color.b, lit = y * sqrt(0.5);
    double share = lit / (lit + 0.5), pixel = 3 * camera->ortho_half_height * 2 / SIZE;
    int inside = 0, outside = 0;
    if (pixel == 0)
        pixel = 0.15;
    for (int j = 0; j < SIZE; j++)
        for (int i = 0; i < SIZE; i++) {
            const float *p = at(&image, i, j);
            lam_vec3 point = on_plane(camera, i, j, report.ground_height);
            if (p[0] > 0 || fabs(point.x) + fabs(point.z) < 0.2 || fabs(point.x) > 4 || fabs(point.z) > 4)
                continue; // the model, the ball's shadow, and the fading border of the ground
            double beyond = fmax(fabs(point.x - 1), fabs(point.z)) - 1;
            assert_true(p[1] == 0 && p[2] == 0);
            if (beyond < -pixel) {
                assert_true(fabs((double)p[3] - share) < 1e-5);
                inside++;
            } else if (beyond > pixel) {
                assert_true(p[3] == 0);
                outside++;
            }
        }
    assert_true(inside > 100 && outside > 1000);
}

TEST(test_shadow)
{
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){6, 4, 5};
    camera.target = (lam_vec3){1, 0, 0};
    camera.ortho_half_height = 2.5;
    check_shadow(&camera, (lam_rgb){1, 1, 1});
    check_shadow(&camera, (lam_rgb){1, 0.25f, 0});
    camera.ortho_half_height = 0;
    camera.fovy_rad = 0.7;
    check_shadow(&camera, (lam_rgb){1, 1, 1});
}

// Ambient occlusion darkens the ground near a wall, more at smaller distances, and nothing far away.
TEST(test_contact)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    add(scene, "cube", (lam_vec3){1, 1, 1}, (lam_vec3){0, 0, 0});
    lam_scene_set_ambient(scene, (lam_rgb){1, 1, 1});
    for (int ortho = 0; ortho < 2; ortho++) {
        lam_camera camera = lam_camera_default();
        camera.eye = (lam_vec3){0, 6, 8};
        camera.target = (lam_vec3){0, -1, 1.2};
        camera.fovy_rad = 0.12;
        camera.ortho_half_height = ortho ? 0.5 : 0;
        lam_draw_params params = {
            .ground = LAM_GROUND_SHADOW, .occlusion = LAM_OCCLUSION_SCREEN, .rig = LAM_RIG_NONE, .samples = 1};
        lam_image image = draw(scene, &camera, params);
        double near = 0, middle = 0, far = 0;
        int counts[3] = {0};
        for (int j = 0; j < SIZE; j++)
            for (int i = 0; i < SIZE; i++) {
                lam_vec3 point = on_plane(&camera, i, j, -1);
                double away = point.z - 1, alpha = (double)at(&image, i, j)[3];
                if (fabs(point.x) > 0.8 || at(&image, i, j)[0] > 0)
                    continue;
                if (away > 0.02 && away < 0.05 && ++counts[0])
                    near += alpha;
                if (away > 0.08 && away < 0.12 && ++counts[1])
                    middle += alpha;
                if (away > 0.25 && away < 1 && ++counts[2])
                    far = fmax(far, alpha);
            }
        assert_true(counts[0] > 20 && counts[1] > 20 && counts[2] > 100);
        near /= counts[0];
        middle /= counts[1];
        assert_true(near > 0.15 && near < 0.4 && middle > 0.003 && middle < near / 4 && far < 1e-4);
        lam_image_free(&image);
        params.occlusion = LAM_OCCLUSION_OFF;
        image = draw(scene, &camera, params);
        for (int i = 0; i < SIZE * SIZE; i++)
            assert_true(at(&image, i % SIZE, i / SIZE)[0] > 0 || at(&image, i % SIZE, i / SIZE)[3] == 0);
        lam_image_free(&image);
    }
}

static double height_of(const lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    lam_image image = draw(scene, camera, params);
    lam_frame_report report;
    lam_device_report(device, &report);
    lam_image_free(&image);
    assert_true(report.ground);
    return report.ground_height;
}

// The lowest vertex determines the height, also of a rotated model, along the up axis.
TEST(test_height)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    add(scene, "cube", (lam_vec3){1, 2, 3}, (lam_vec3){5, 7, 9});
    lam_draw_params params = {.ground = LAM_GROUND_CHECKER};
    double radius = sqrt(14), drop = radius / 16384;
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    assert_true(fabs(height_of(scene, &camera, params) - (5 - drop)) < 1e-6);
    lam_mat4 turn = lam_mat4_identity(); // by 30° about z, around the middle
    turn.m[0][0] = turn.m[1][1] = sqrt(0.75);
    turn.m[1][0] = 0.5;
    turn.m[0][1] = -0.5;
    turn.m[0][3] = 5 - (5 * sqrt(0.75) - 7 * 0.5);
    turn.m[1][3] = 7 - (5 * 0.5 + 7 * sqrt(0.75));
    assert_true(lam_scene_transform(scene, &turn, &error));
    assert_true(fabs(height_of(scene, &camera, params) - (7 - 0.5 - 2 * sqrt(0.75) - drop)) < 1e-6);
    lam_scene_set_up(scene, LAM_UP_Z);
    camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    assert_true(fabs(height_of(scene, &camera, params) - (6 - drop)) < 1e-6);
    lam_frame_report report;
    lam_device_report(device, &report);
    assert_true(report.ground_square == 1 && report.triangles > 12 && report.triangles_binned <= report.triangles);
}

static bool same(const lam_image *a, const lam_image *b) { return memcmp(a->pixels, b->pixels, SIZE * SIZE * 16) == 0; }

// From below there is no ground, nor in pictures of quantities if it only catches shadows; the scene's own shadows
// remain. The rig is given, because the default rig has other lights if a ground is requested.
TEST(test_absent)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    add(scene, "torus-knot", (lam_vec3){1, 1, 1}, (lam_vec3){0, 0, 0});
    for (int ortho = 0; ortho < 2; ortho++) {
        lam_camera camera = lam_camera_default();
        camera.eye = (lam_vec3){3, -4, 2};
        camera.ortho_half_height = ortho ? 1.2 : 0;
        lam_image with =
            draw(scene, &camera, (lam_draw_params){.ground = LAM_GROUND_COLOR, .rig = LAM_RIG_THREE_POINT});
        lam_frame_report report;
        lam_device_report(device, &report);
        assert_false(report.ground);
        lam_image without = draw(scene, &camera, (lam_draw_params){.shadows = true, .rig = LAM_RIG_THREE_POINT});
        assert_true(same(&with, &without));
        lam_image_free(&with);
        lam_image_free(&without);
        camera.eye.y = 4;
        with = draw(scene, &camera, (lam_draw_params){.ground = LAM_GROUND_SHADOW, .output = LAM_OUTPUT_DEPTH});
        without = draw(scene, &camera, (lam_draw_params){.output = LAM_OUTPUT_DEPTH});
        assert_true(same(&with, &without));
        lam_image_free(&with);
        with = draw(scene, &camera, (lam_draw_params){.ground = LAM_GROUND_CHECKER, .output = LAM_OUTPUT_DEPTH});
        assert_false(same(&with, &without));
        lam_image_free(&with);
        lam_image_free(&without);
    }
}

// A picture over a background shows the catcher's alpha over it, and terms have the same alpha.
TEST(test_premultiplied)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    add(scene, "sphere", (lam_vec3){1, 1, 1}, (lam_vec3){0, 0, 0});
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    lam_draw_params params = {.ground = LAM_GROUND_SHADOW};
    AUTO_IMAGE clear = draw(scene, &camera, params);
    params.output = LAM_OUTPUT_DIFFUSE;
    AUTO_IMAGE term = draw(scene, &camera, params);
    params.output = LAM_OUTPUT_PICTURE;
    params.background = (lam_rgba){0.5f, 0.25f, 1, 1};
    AUTO_IMAGE over = draw(scene, &camera, params);
    int caught = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float *c = at(&clear, i % SIZE, i / SIZE), *o = at(&over, i % SIZE, i / SIZE);
        assert_true(fabsf(c[0] + (1 - c[3]) * 0.5f - o[0]) < 1e-5f && fabsf(c[2] + (1 - c[3]) - o[2]) < 1e-5f);
        assert_true(o[3] == 1 && at(&term, i % SIZE, i / SIZE)[3] == c[3]);
        caught += c[0] == 0 && c[3] > 0.1f && c[3] < 0.9f;
    }
    assert_true(caught > 200);
}

static void refused(lam_draw_params params, const char *says)
{
    AUTO_SCENE scene = lam_scene_make(&error);
    add(scene, "sphere", (lam_vec3){1, 1, 1}, (lam_vec3){0, 0, 0});
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    AUTO_IMAGE image = {0};
    lam_image_make(&image, SIZE, SIZE, LAM_RGBA8, &error);
    assert_false(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, says));
}

TEST(test_refused)
{
    refused((lam_draw_params){.ground = LAM_GROUND_COUNT}, "lam_ground");
    refused((lam_draw_params){.ground = LAM_GROUND_COLOR, .ground_color = {0, -1, 0}}, "ground_color");
    refused((lam_draw_params){.ground = LAM_GROUND_SHADOW, .shading = LAM_SHADING_FLAT}, "Phong");
    assert_string_equal(lam_ground_name(LAM_GROUND_CHECKER), "checker");
    assert_null(lam_ground_name(LAM_GROUND_COUNT));
    AUTO_SCENE empty = lam_scene_make(&error);
    lam_camera camera = lam_camera_default();
    AUTO_IMAGE image = draw(empty, &camera, (lam_draw_params){.ground = LAM_GROUND_COLOR});
    assert_true(at(&image, 64, 64)[3] == 0);
}

// Sizes whose ground is not representable: the model is drawn without it. A light of an unknown type has no field.
TEST(test_extreme_sizes)
{
    static const double sizes[][2] = {{1e-90, 0},    {1e-90, 1}, {1e-40, 1e30}, {1e90, 0},
                                      {1e90, 1e100}, {1, 1e160}, {1, 1e300}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int ground = LAM_GROUND_SHADOW; ground <= LAM_GROUND_CHECKER; ground++) {
            AUTO_SCENE scene = lam_scene_make(&error);
            double s = sizes[i][0], at = sizes[i][1];
            add(scene, "cube", (lam_vec3){s, s, s}, (lam_vec3){at, at, at});
            add(scene, "cube", (lam_vec3){s, s, s}, (lam_vec3){-at, at, -at});
            lam_camera camera = {
                .eye = {0, 2 * at + 3 * s, at + 5 * s}, .target = {0, at, 0}, .up = {0, 1, 0}, .fovy_rad = 0.5};
            AUTO_IMAGE image = {0};
            assert_true(lam_image_make(&image, 16, 16, LAM_RGBA8, &error));
            lam_draw_params params = {.ground = (lam_ground)ground};
            lam_draw(device, scene, &camera, &params, &image, NULL,
                     &error); // may fail, but without undefined behaviour
        }
    lam_light light = lam_light_default((lam_light_type)1000);
    assert_int_equal(light.type, 1000);
}

FIXTURE(set_up, tear_down)
