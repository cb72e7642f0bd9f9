// test_ground_fit.c: the camera of a picture with a ground plane, and the shadow on it, which fades out before the
// border.
#include "test.h"
#include "../lighting/random.h"
#include "loading.h"

enum { SIDE = 160 };

struct placed {
    lam_scene *scene;
    lam_draw_params params;
};

// A shape under a directional light at an elevation above the horizon.
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

// The largest alpha at the border of the picture, 0…255: a cut-off shadow reaches it.
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

static lam_camera fitted(const struct placed *p, const lam_view *view, const lam_vec3 *axis)
{
    lam_vec3 centre = {0, 0, 0};
    assert_true(lam_scene_sphere(p->scene, -1, &centre, NULL));
    return lam_camera_fit_ground(p->scene, &p->params, SIDE, SIDE, view, centre, axis);
}

// The first and last column (row) of the picture covered by the model.
static void model_box(const struct placed *p, const lam_camera *camera, int box[4])
{
    lam_error error = {0};
    AUTO_IMAGE image = {0};
    AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
    lam_draw_params params = {.ground = LAM_GROUND_NONE};
    assert_true(lam_image_make(&image, SIDE, SIDE, LAM_RGBA8, &error));
    assert_true(lam_draw(device, p->scene, camera, &params, &image, NULL, &error));
    box[0] = box[2] = SIDE, box[1] = box[3] = -1;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            if (((const uint8_t *)image.pixels)[4 * (y * SIDE + x) + 3]) {
                box[0] = x < box[0] ? x : box[0], box[1] = x > box[1] ? x : box[1];
                box[2] = y < box[2] ? y : box[2], box[3] = y > box[3] ? y : box[3];
            }
}

// Shadows of lights from all around, hard and soft, long and short, end before the border; the model is in the middle
// and fills four fifths of the picture.
TEST(shadows_end_before_the_border)
{
    const char *shapes[] = {"cube", "torus-knot", "cylinder"};
    int seen = 0;
    for (int azimuth = 0; azimuth < 360; azimuth += 45)
        for (int s = 0; s < 3; s++) {
            struct placed p = place(shapes[s], azimuth, azimuth % 2 ? 60 : 12, s == 1 ? 0.1f : 0);
            lam_view view = {.orthographic = azimuth % 90 != 0};
            lam_camera camera = fitted(&p, &view, NULL), alone = lam_camera_fit(p.scene, SIDE, SIDE, &view);
            int alpha = border_alpha(&p, &camera), box[4];
            if (alpha > 4) // over white: 251
                fail_msg("%s, light from %d degrees: alpha %d at the border", shapes[s], azimuth, alpha);
            model_box(&p, &camera, box);
            int width = box[1] - box[0] + 1, height = box[3] - box[2] + 1;
            assert_in_range(width > height ? width : height, 126, 130); // 0.8 of 160
            assert_in_range(box[0] + box[1] + 1, SIDE - 2, SIDE + 2);
            assert_in_range(box[2] + box[3] + 1, SIDE - 2, SIDE + 2);
            seen += !!memcmp(&camera, &alone, sizeof camera);
            lam_scene_free(p.scene);
        }
    assert_int_equal(seen, 24);
}

// Without a ground, the camera equals lam_camera_fit's; a fill given by the caller is kept.
TEST(no_ground_no_change)
{
    struct placed p = place("torus-knot", 30, 40, 0);
    lam_view given = {.fill = 0.5}, view = {0};
    lam_camera alone = lam_camera_fit(p.scene, SIDE, SIDE, &given), camera = fitted(&p, &given, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    p.params.ground = LAM_GROUND_NONE;
    alone = lam_camera_fit(p.scene, SIDE, SIDE, &view);
    camera = fitted(&p, &view, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    camera = lam_camera_fit_ground(p.scene, NULL, SIDE, SIDE, &view, (lam_vec3){0}, NULL);
    assert_memory_equal(&alone, &camera, sizeof camera);
    lam_scene_free(p.scene);
}

// One camera shows a rotating model and its shadow at every angle.
TEST(turning_shadows_end_before_the_border)
{
    const lam_vec3 up = {0, 1, 0};
    struct placed p = place("torus-knot", -60, 60, 0);
    lam_vec3 centre;
    lam_camera camera = fitted(&p, NULL, &up);
    assert_true(lam_scene_sphere(p.scene, -1, &centre, NULL));
    for (int angle = 0; angle < 360; angle += 30) {
        int alpha = border_alpha(&p, &camera);
        if (alpha > 4) // over white: 251
            fail_msg("turned by %d degrees: alpha %d at the border", angle, alpha);
        assert_true(lam_scene_rotate(p.scene, centre, up, 30 * 0.017453292519943295, NULL));
    }
    lam_scene_free(p.scene);
}
