// test_orbit.c: the orbit of a fitted camera: rotating, moving and zooming.

#include "test.h"

static const double PI_HALF = 1.57079632679489661923;

static void near_vector(lam_vec3 a, lam_vec3 b)
{
    if (!(fabs(a.x - b.x) + fabs(a.y - b.y) + fabs(a.z - b.z) < 1e-9))
        fail_msg("(%g, %g, %g), expected (%g, %g, %g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

static lam_scene *teapot(lam_up up)
{
    lam_scene *scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "teapot", NULL, NULL);
    assert_true(lam_scene_add_object(scene, &object, NULL) == 0);
    lam_scene_set_up(scene, up);
    return scene;
}

// The position of a point of the world in a picture of 100 × 100 pixels.
static void project(const lam_camera *camera, lam_vec3 p, double *x, double *y)
{
    lam_mat4 m = lam_camera_view_matrix(camera);
    lam_vec3 at = {0, 0, 0};
    double *out[3] = {&at.x, &at.y, &at.z};
    for (int i = 0; i < 3; i++)
        *out[i] = m.m[i][0] * p.x + m.m[i][1] * p.y + m.m[i][2] * p.z + m.m[i][3];
    assert_true(lam_camera_project(camera, 100, 100, at, x, y));
}

TEST(all_sides)
{
    for (int up = LAM_UP_X; up < LAM_UP_COUNT; up++)
        for (int side = 0; side < LAM_SIDE_COUNT; side++) {
            AUTO_SCENE scene = teapot((lam_up)up);
            lam_view view = lam_view_of_side((lam_side)side);
            lam_camera fitted = lam_camera_fit(scene, 100, 100, &view);
            lam_orbit orbit = lam_orbit_of(&fitted, scene);
            lam_camera camera = lam_orbit_camera(&orbit);
            near_vector(camera.eye, fitted.eye); // the same picture
            lam_vec3 a = camera.up, b = fitted.up;
            near_vector(a, b);
            assert_true(camera.fovy_rad == fitted.fovy_rad && camera.ortho_half_height == fitted.ortho_half_height);
            lam_orbit_turn(&orbit, 0.5, -0.25);
            double x, y;
            camera = lam_orbit_camera(&orbit);
            project(&camera, orbit.target, &x, &y);
            assert_true(fabs(x - 50) < 1e-9 && fabs(y - 50) < 1e-9);
        }
}

TEST(turns)
{
    lam_orbit orbit = {.target = {1, 2, 3}, .distance = 4, .fovy_rad = 0.5};
    near_vector(lam_orbit_camera(&orbit).eye, (lam_vec3){1, 2, 7}); // the front
    lam_orbit_turn(&orbit, PI_HALF, 0);
    near_vector(lam_orbit_camera(&orbit).eye, (lam_vec3){5, 2, 3}); // the right side
    lam_orbit_turn(&orbit, 0, 9);
    assert_true(orbit.elevation_rad == PI_HALF);
    near_vector(lam_orbit_camera(&orbit).eye, (lam_vec3){1, 6, 3});
    near_vector(lam_orbit_camera(&orbit).up, (lam_vec3){-1, 0, 0});
    lam_orbit_turn(&orbit, 0, -9);
    assert_true(orbit.elevation_rad == -PI_HALF);
    lam_orbit_turn(&orbit, NAN, 0);
    assert_true(orbit.azimuth_rad == PI_HALF);
}

TEST(pans_and_zooms)
{
    for (int flat = 0; flat < 2; flat++) {
        lam_orbit orbit = {.target = {1, 2, 3},
                           .azimuth_rad = 0.7,
                           .elevation_rad = 0.4,
                           .distance = 4,
                           .fovy_rad = 0.5,
                           .ortho_half_height = flat ? 1.5 : 0};
        const lam_vec3 point = orbit.target;
        double x, y;
        lam_orbit_pan(&orbit, -0.1, 0.2); // the mouse was dragged by 10 pixels to the right and 20 down
        lam_camera camera = lam_orbit_camera(&orbit);
        project(&camera, point, &x, &y);
        assert_true(fabs(x - 60) < 1e-9 && fabs(y - 70) < 1e-9);
        lam_orbit_zoom(&orbit, 2);
        camera = lam_orbit_camera(&orbit);
        project(&camera, point, &x, &y);
        assert_true(fabs(x - 70) < 1e-9 && fabs(y - 90) < 1e-9);
        const lam_orbit before = orbit;
        lam_orbit_zoom(&orbit, 0);
        lam_orbit_pan(&orbit, INFINITY, 0);
        assert_memory_equal(&orbit, &before, sizeof orbit);
        orbit.reserved[3] = 1;
        assert_true(lam_orbit_camera(&orbit).reserved[0] != 0); // refused when drawing
    }
}
