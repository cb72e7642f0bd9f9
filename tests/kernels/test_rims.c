// test_rims.c: on a closed surface, the picture with back faces equals the picture without them.
//
// Every back face of a closed surface is behind a front face. At the outline, the two meet in an edge, and a sample
// near it shows the back face if the depth planes of the two disagree about which is nearer. A sample exactly on the
// edge has the same depth on both, and rounding decides: one pixel in some forty frames, none of these at 1 sample.

#include "test.h"
#include "share.h"

enum { SIZE = 512, VIEWS = 6, VISIBLE = 16 };

static const struct closed {
    const char *name;
    lam_shape_params params;
} models[] = {
    {"sphere", {.radius = 1}},
    {"sphere", {.slices = 1200, .stacks = 700}}, // triangles of a pixel or less
    {"torus", {.radius = 1}},
    {"torus-knot", {.radius = 1}},
    {"torus-knot", {.slices = 60, .stacks = 9}},
    {"metaballs", {.radius = 1}},
    {"gyroid", {.radius = 1}},
    {"cylinder", {.radius = 1}}, // long slivers
    {"cube", {.radius = 1}},     // triangles larger than a tile
};

static lam_scene *scene_of(const struct closed *model, lam_cull cull)
{
    lam_error error = {0};
    lam_scene *scene = lam_scene_make(NULL);
    lam_material material = lam_material_default();
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, model->name, &model->params, &error);
    object.material = lam_scene_add_material(scene, &material, &error);
    object.cull = cull;
    if (object.mesh < 0 || lam_scene_add_object(scene, &object, &error) < 0)
        fail_msg("%s: %s", model->name, error.text);
    return scene;
}

static lam_image draw(lam_device *device, const lam_scene *scene, const lam_view *view, int samples)
{
    lam_error error = {0};
    lam_image image = {0};
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, view);
    // Occlusion differs: a back face that is not drawn hides no light.
    lam_draw_params params = {
        .samples = samples, .rig = LAM_RIG_STUDIO, .occlusion = LAM_OCCLUSION_OFF, .cavity = LAM_CAVITY_OFF};
    if (!lam_image_make(&image, SIZE, SIZE, LAM_RGBA8, &error) ||
        !lam_draw(device, scene, &camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    return image;
}

// The number of pixels with a channel that differs by more than VISIBLE.
static int pixels_off(const lam_image *a, const lam_image *b)
{
    const uint8_t *p = a->pixels, *q = b->pixels;
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        bool off = false;
        for (int c = 0; c < 4; c++)
            off |= abs(p[4 * i + c] - q[4 * i + c]) > VISIBLE;
        count += off;
    }
    return count;
}

// The mean number of different pixels per frame, over models and views.
static double mean_off(int samples)
{
    lam_error error = {0};
    lam_device *device = lam_device_cpu(NULL, &error);
    int count = 0, frames = 0;
    for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
        lam_scene *whole = scene_of(&models[m], LAM_CULL_NONE), *culled = scene_of(&models[m], LAM_CULL_BACK);
        int of_model = 0;
        for (int v = 0; v < VIEWS; v++) {
            if (!is_taken(m + (size_t)v, 3))
                continue;
            frames++;
            lam_view view = {.from_angles = true,
                             .azimuth_rad = 0.3 + 1.1 * v,
                             .elevation_rad = 0.9 - 0.37 * v,
                             .orthographic = v % 3 == 2};
            lam_image a = draw(device, whole, &view, samples), b = draw(device, culled, &view, samples);
            of_model += pixels_off(&a, &b);
            lam_image_free(&a);
            lam_image_free(&b);
        }
        print_message("%s, %d samples: %d pixels\n", models[m].name, samples, of_model);
        count += of_model;
        lam_scene_free(whole);
        lam_scene_free(culled);
    }
    lam_device_free(device);
    return (double)count / frames;
}

TEST(test_one_sample) { assert_true(mean_off(1) == 0); }

TEST(test_four_samples) { assert_true(mean_off(4) <= 0.25); }
