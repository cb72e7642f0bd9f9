// test_ground_fit.c: the camera of a picture with a ground shows the shadows that fall on it, and keeps the model's size
// within its bound.
#include "../lighting/random.h"
#include "loading.h"

#include <math.h>

enum { SIDE = 160 };

struct placed {
    lam_scene *scene;
    lam_draw_params params;
};

// A shape under a directional light that stands at an elevation over the horizon.
static struct placed place(const char *shape, double azimuth_deg, double elevation_deg, float angular_radius_rad)
{
    struct placed p = {.scene = lam_scene_make(NULL)};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(p.scene, shape, NULL, NULL);
    assert_true(lam_scene_add_object(p.scene, &object, NULL) == 0);
    double a = azimuth_deg * 0.017453292519943295, e = elevation_deg * 0.017453292519943295;
    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    light.direction = (lam_vec3){-cos(e) * sin(a), -sin(e), -cos(e) * cos(a)};
    light.angular_radius_rad = angular_radius_rad;
    assert_true(lam_scene_add_light(p.scene, &light, NULL) == 0);
    p.params.ground = LAM_GROUND_SHADOW;
    return p;
}

// The largest alpha in the border of the picture, 0…255: a shadow that is cut reaches it.
static int border_alpha(const struct placed *p, const lam_camera *camera)
{
    lam_error error = {0};
    lam_image image = {0};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
    assert_non_null(device);
    assert_true(lam_image_make(&image, SIDE, SIDE, LAM_RGBA8, &error));
    assert_true(lam_draw(device, p->scene, camera, &p->params, &image, NULL, &error));
    int most = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            int alpha = ((const uint8_t *)image.pixels)[4 * (y * SIDE + x) + 3];
            bool border = x < 2 || y < 2 || x >= SIDE - 2 || y >= SIDE - 2;
            most = border && alpha > most ? alpha : most;
        }
    lam_image_free(&image);
    lam_device_free(device);
    return most;
}

// How large the scene's middle is seen, relative to the camera for the scene alone.
static double relative_size(const struct placed *p, const lam_camera *camera, const lam_camera *alone)
{
    if (camera->ortho_half_height > 0)
        return alone->ortho_half_height / camera->ortho_half_height;
    lam_vec3 middle;
    assert_true(lam_scene_sphere(p->scene, -1, &middle, NULL));
    double depth[2];
    for (int i = 0; i < 2; i++) {
        lam_mat4 m = lam_camera_view_matrix(i ? camera : alone);
        depth[i] = -(m.m[2][0] * middle.x + m.m[2][1] * middle.y + m.m[2][2] * middle.z + m.m[2][3]);
    }
    return depth[0] / depth[1];
}

static lam_camera fitted(const struct placed *p, const lam_view *view, const lam_vec3 *axis)
{
    lam_vec3 centre = {0, 0, 0};
    assert_true(lam_scene_sphere(p->scene, -1, &centre, NULL));
    return lam_camera_fit_ground(p->scene, &p->params, SIDE, SIDE, view, centre, axis);
}

// Shadows of lights from all around, hard ones and soft ones, are in the picture, and few were before.
static void shadows_are_in_the_picture(void **state)
{
    (void)state;
    const char *shapes[] = {"cube", "torus-knot", "cylinder"};
    int cut_before = 0, cases = 0;
    for (int azimuth = 0; azimuth < 360; azimuth += 45)
        for (int s = 0; s < 3; s++, cases++) {
            struct placed p = place(shapes[s], azimuth, 60, s == 1 ? 0.1f : 0);
            lam_view view = {.orthographic = azimuth % 90 != 0};
            lam_camera alone = lam_camera_fit(p.scene, SIDE, SIDE, &view), camera = fitted(&p, &view, NULL);
            int after = border_alpha(&p, &camera);
            cut_before += border_alpha(&p, &alone) > 64;
            if (after > 24)
                fail_msg("%s, light from %d degrees: alpha %d at the border", shapes[s], azimuth, after);
            double size = relative_size(&p, &camera, &alone);
            if (!(size >= 0.6999 && size <= 1 + 1e-9))
                fail_msg("%s, light from %d degrees: size %g", shapes[s], azimuth, size);
            lam_scene_free(p.scene);
        }
    if (cut_before < cases / 4)
        fail_msg("only %d of %d shadows were cut by the camera for the model alone", cut_before, cases);
}

// A light at the horizon throws its shadow without end: the model keeps 0.7 of its size, and no more than that is
// given up.
static void a_low_light_keeps_the_model_large(void **state)
{
    (void)state;
    for (int elevation = 0; elevation <= 4; elevation += 2)
        for (int flat = 0; flat < 2; flat++) {
            struct placed p = place("cube", -80, elevation + 0.01, 0);
            lam_view view = {.orthographic = flat};
            lam_camera alone = lam_camera_fit(p.scene, SIDE, SIDE, &view), camera = fitted(&p, &view, NULL);
            double size = relative_size(&p, &camera, &alone);
            if (!(size >= 0.6999 && size < 0.71))
                fail_msg("light at %d degrees: size %g, expected 0.7", elevation, size);
            lam_scene_free(p.scene);
        }
}

// Without a ground, and where its under side would be seen, it is the camera of lam_camera_fit.
static void no_ground_no_change(void **state)
{
    (void)state;
    struct placed p = place("torus-knot", 30, 40, 0);
    lam_view below = {.from_angles = true, .elevation_rad = -0.5}, above = {0};
    lam_camera alone = lam_camera_fit(p.scene, SIDE, SIDE, &below), camera = fitted(&p, &below, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    p.params.ground = LAM_GROUND_NONE;
    alone = lam_camera_fit(p.scene, SIDE, SIDE, &above);
    camera = fitted(&p, &above, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    camera = lam_camera_fit_ground(p.scene, NULL, SIDE, SIDE, &above, (lam_vec3){0}, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    lam_scene_free(p.scene);
}

// Thousands of lights cost no more than their bound: from there on the camera is that of the scene alone.
static void many_lights_take_no_memory(void **state)
{
    (void)state;
    struct placed p = place("cube", 30, 40, 0.1f);
    lam_camera alone = lam_camera_fit(p.scene, SIDE, SIDE, NULL), camera = fitted(&p, NULL, NULL);
    assert_memory_not_equal(&alone, &camera, sizeof camera);
    lam_light light = *lam_scene_light(p.scene, 0);
    for (int i = 0; i < 2000; i++)
        assert_true(lam_scene_add_light(p.scene, &light, NULL) >= 0);
    camera = fitted(&p, NULL, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    lam_scene_free(p.scene);
}

// One camera shows the shadows of a turning model at every angle.
static void turning_shadows_are_in_the_picture(void **state)
{
    (void)state;
    const lam_vec3 up = {0, 1, 0};
    struct placed p = place("torus-knot", -60, 60, 0);
    lam_vec3 centre;
    lam_camera camera = fitted(&p, NULL, &up);
    assert_true(lam_scene_sphere(p.scene, -1, &centre, NULL));
    for (int angle = 0; angle < 360; angle += 30) {
        int alpha = border_alpha(&p, &camera);
        if (alpha > 24)
            fail_msg("turned by %d degrees: alpha %d at the border", angle, alpha);
        assert_true(lam_scene_rotate(p.scene, centre, up, 30 * 0.017453292519943295, NULL));
    }
    lam_scene_free(p.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadows_are_in_the_picture),
        cmocka_unit_test(a_low_light_keeps_the_model_large),
        cmocka_unit_test(no_ground_no_change),
        cmocka_unit_test(many_lights_take_no_memory),
        cmocka_unit_test(turning_shadows_are_in_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
