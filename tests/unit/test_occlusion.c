// test_occlusion.c: ambient occlusion against what is known: planes have none, and a floor beside a wall has the integral over
// all directions; and when a frame has any.
#include <lambent/lambent.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SIZE = 256 };

// A rectangle in the scene, from a corner along two edges.
static void add_rectangle(lam_scene *scene, lam_vec3 at, lam_vec3 u, lam_vec3 v)
{
    float p[12];
    for (int i = 0; i < 4; i++) {
        double s = i == 1 || i == 2, t = i >= 2;
        p[3 * i] = (float)(at.x + s * u.x + t * v.x);
        p[3 * i + 1] = (float)(at.y + s * u.y + t * v.y);
        p[3 * i + 2] = (float)(at.z + s * u.z + t * v.z);
    }
    lam_mesh mesh = {.positions = p, .vertex_count = 4, .indices = (uint32_t[]){0, 1, 2, 0, 2, 3}, .triangle_count = 2};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, NULL);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, NULL) >= 0);
}

// The share at each pixel; −1 where nothing is. The caller frees it.
static float *shares(const lam_scene *scene, const lam_camera *camera, lam_draw_params params)
{
    lam_error error;
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_image image = {0};
    params.output = LAM_OUTPUT_AMBIENT_OCCLUSION;
    assert_true(lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error));
    if (!device || !lam_draw(device, scene, camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    float *out = malloc(sizeof *out * SIZE * SIZE);
    assert_non_null(out);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float *pixel = (const float *)image.pixels + 4 * (ptrdiff_t)i;
        out[i] = pixel[3] > 0 ? pixel[0] : -1;
    }
    lam_image_free(&image);
    lam_device_free(device);
    return out;
}

// However a plane lies, in perspective or not: exactly all of the light, but for rounding.
static void test_planes(void **state)
{
    (void)state;
    for (int turn = 0; turn < 8; turn++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            lam_scene *scene = lam_scene_make(NULL);
            add_rectangle(scene, (lam_vec3){-1, -1, 0}, (lam_vec3){2, 0, 0}, (lam_vec3){0, 2, 0});
            lam_camera camera = {
                .eye = {2.5 * sin(0.18 * turn), 0.3 * turn, 2.5 * cos(0.18 * turn)}, .up = {0, 1, 0}, .fovy_rad = 0.9};
            if (orthographic)
                camera.ortho_half_height = 1.2;
            float *a = shares(scene, &camera, (lam_draw_params){.samples = turn % 2 ? 8 : 1});
            int seen = 0;
            for (int i = 3 * SIZE + 3; i < SIZE * (SIZE - 3) - 3; i++) {
                // At the plane's rim samples do not lie around the pixels' centres, and the filter spreads that.
                bool inside = true;
                for (int y = -3; y <= 3; y++)
                    for (int x = -3; x <= 3; x++)
                        inside &= a[i + y * SIZE + x] >= 0;
                seen += inside;
                if (inside && a[i] < 0.997f)
                    fail_msg("turn %d: pixel %d,%d has %g", turn, i % SIZE, i / SIZE, (double)a[i]);
            }
            assert_true(seen > SIZE * SIZE / 20);
            free(a);
            lam_scene_free(scene);
        }
}

// A floor with a wall across, looked down upon. Near the wall the radius does not matter, and the wall is as good as infinite
// to the sides; beyond the radius nothing occludes.
static void test_wall(void **state)
{
    (void)state;
    const double radius = 0.25;
    lam_scene *scene = lam_scene_make(NULL);
    add_rectangle(scene, (lam_vec3){-4, 0, 0}, (lam_vec3){0, 0, 8}, (lam_vec3){8, 0, 0});
    add_rectangle(scene, (lam_vec3){-4, 0, 0}, (lam_vec3){8, 0, 0}, (lam_vec3){0, 4, 0});
    lam_camera camera = {.eye = {0, 3, 3}, .target = {0, 0, 0.5}, .up = {0, 1, 0}, .ortho_half_height = 1.5};
    lam_vec3 low, high;
    assert_true(lam_scene_bounds(scene, &low, &high));
    double half = 0.5 * sqrt(8.0 * 8 + 4 * 4 + 8 * 8);
    float *a = shares(scene, &camera, (lam_draw_params){.samples = 1, .occlusion_radius = (float)(radius / half)});
    // The middle column, from the wall's foot towards the eye: each row is a step dz along the floor.
    double slope = sqrt(3 * 3 + 2.5 * 2.5), dz = 3.0 / SIZE * slope / 3;
    double foot = SIZE / 2 - 0.5 / dz; // row of the foot: the view's middle is at z = 0.5
    double before = 0;
    int checked = 0;
    for (int row = (int)foot + 2; row < SIZE; row++) {
        double d = (row + 0.5 - foot) * dz, share = (double)a[row * SIZE + SIZE / 2];
        assert_true(share > before - 0.02); // lighter and lighter, but for noise
        before = share > before ? share : before;
        // The mean over cosine-weighted directions, each occluded by the share that its way to the wall leaves of the radius.
        double exact = 0, all = 0;
        for (int i = 0; i < 200; i++)
            for (int k = 0; k < 400; k++) {
                double r = sqrt((i + 0.5) / 200), way = d / fmax(-r * cos((k + 0.5) * M_PI / 200), 1e-9);
                exact += cos((k + 0.5) * M_PI / 200) < 0 ? 1 - fmin(fmax((radius - way) / (0.4 * radius), 0), 1) : 1;
                all++;
            }
        exact /= all;
        if (!(share > exact - 0.03 && share < exact + 0.13)) // four samples miss some of a horizon
            fail_msg("%g from the wall: %g, expected %g", d, share, exact);
        checked += share < 0.9;
    }
    assert_true(checked > 3);
    free(a);
    lam_scene_free(scene);
}

static bool same_picture(const lam_scene *scene, lam_draw_params a, lam_draw_params b)
{
    lam_error error;
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_fit(scene, 64, 64, NULL);
    lam_image images[2] = {{0}};
    for (int i = 0; i < 2; i++) {
        assert_true(lam_image_make(&images[i], 64, 64, LAM_RGBA32F, &error));
        if (!lam_draw(device, scene, &camera, i ? &b : &a, &images[i], NULL, &error))
            fail_msg("%s", error.text);
    }
    bool same = true;
    for (int i = 0; i < 64 * 64 * 4; i++)
        same &= ((float *)images[0].pixels)[i] == ((float *)images[1].pixels)[i];
    lam_image_free(&images[0]);
    lam_image_free(&images[1]);
    lam_device_free(device);
    return same;
}

// The studio has occlusion and lights by hand have none, unless they say so; it needs Phong shading.
static void test_when(void **state)
{
    (void)state;
    lam_error error;
    lam_scene *scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "gyroid", NULL, &error);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    const lam_draw_params plain = {.occlusion_radius = 0.3f}, off = {.occlusion = LAM_OCCLUSION_OFF},
                          screen = {.occlusion = LAM_OCCLUSION_SCREEN, .occlusion_radius = 0.3f};
    assert_false(same_picture(scene, plain, off));
    assert_true(same_picture(scene, plain, screen));
    lam_draw_params flat = plain, flat_off = off;
    flat.shading = flat_off.shading = LAM_SHADING_FLAT;
    assert_true(same_picture(scene, flat, flat_off));
    lam_draw_params unlit = plain, unlit_off = off;
    unlit.reflection = unlit_off.reflection = LAM_REFLECTION_NONE;
    assert_true(same_picture(scene, unlit, unlit_off));

    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    assert_int_equal(lam_scene_add_light(scene, &light, &error), 0);
    assert_true(same_picture(scene, plain, off));
    assert_true(same_picture(scene, screen, off)); // no light that it could dim
    light.occluded = 1;
    assert_int_equal(lam_scene_add_light(scene, &light, &error), 1);
    assert_false(same_picture(scene, plain, off));

    flat.occlusion = LAM_OCCLUSION_SCREEN;
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_fit(scene, 64, 64, NULL);
    lam_image image = {0};
    assert_true(lam_image_make(&image, 64, 64, LAM_RGBA8, &error));
    assert_false(lam_draw(device, scene, &camera, &flat, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_draw_params wrong = {.occlusion_radius = 11};
    assert_false(lam_draw(device, scene, &camera, &wrong, &image, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_image_free(&image);
    lam_device_free(device);
    lam_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planes),
        cmocka_unit_test(test_wall),
        cmocka_unit_test(test_when),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
