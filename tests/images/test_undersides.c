// test_undersides.c: under the default lights, no side of a model is black: all shared models from six sides.
#include "test.h"
#include "../unit/loading.h"
#include "share.h"

#include <dirent.h>
#include <sys/stat.h>

enum { SIDE = 96, DARK = 12 };

// The share of dark pixels that a side may show, and the least base colour that counts.
#define SHARE_MAX 0.001
#define BASE_MIN  0.2f

// Two sides of scans show more: the tone curve for contrast darkens light that grazes the hairs of a tail, and a fold.
static const struct {
    const char *path;
    lam_side side;
    double share;
} darker[] = {{"found/obj/WusonOBJ.obj", LAM_SIDE_FRONT, 0.014}, {"cat/cat-low-resolution.obj", LAM_SIDE_RIGHT, 0.002}};

static lam_device *device;
static size_t seen;
static int drawn, failed;

static float largest(const float *color)
{
    float rg = color[0] > color[1] ? color[0] : color[1];
    return rg > color[2] ? rg : color[2];
}

// Returns the share of the opaque pixels with a light base colour, metal excluded, that are dark.
static double dark_share(const lam_scene *scene, lam_side side)
{
    const lam_view view = lam_view_of_side(side);
    const lam_camera camera = lam_camera_fit(scene, SIDE, SIDE, &view);
    lam_draw_params params = {.samples = 0};
    lam_image picture, base, metal;
    const struct {
        lam_image *image;
        lam_output output;
        lam_pixel_format format;
    } rows[] = {{&picture, LAM_OUTPUT_PICTURE, LAM_RGBA8},
                {&base, LAM_OUTPUT_BASE_COLOR, LAM_RGBA32F},
                {&metal, LAM_OUTPUT_METALLIC, LAM_RGBA32F}};
    bool ok = true; // hostile files exceed the limit on layers
    for (int i = 0; i < 3; i++) {
        lam_error error = {0};
        params.output = rows[i].output;
        ok = lam_image_make(rows[i].image, SIDE, SIDE, rows[i].format, &error) &&
             lam_draw(device, scene, &camera, &params, rows[i].image, NULL, &error) && ok;
        if (!ok && error.code && error.code != LAM_LIMIT)
            fail_msg("%s", error.text);
    }
    int counted = 0, dark = 0;
    for (int i = 0; ok && i < SIDE * SIDE; i++) {
        const uint8_t *p = (const uint8_t *)picture.pixels + 4 * (size_t)i;
        const float *color = (const float *)base.pixels + 4 * (size_t)i;
        if (p[3] < 255 || !(largest(color) > BASE_MIN) || ((const float *)metal.pixels)[4 * (size_t)i] > 0)
            continue;
        counted++;
        dark += p[0] < DARK && p[1] < DARK && p[2] < DARK;
    }
    lam_image_free(&picture);
    lam_image_free(&base);
    lam_image_free(&metal);
    return counted ? (double)dark / counted : 0;
}

static void check_file(const char *path)
{
    lam_scene *scene = lam_scene_load(path, NULL, NULL, NULL);
    // A file's own lights are not the default lights.
    for (int side = LAM_SIDE_FRONT; scene && !lam_scene_light_count(scene) && side <= LAM_SIDE_BOTTOM; side++) {
        const double share = dark_share(scene, (lam_side)side);
        double most = SHARE_MAX;
        for (size_t i = 0; i < sizeof darker / sizeof *darker; i++)
            most = strstr(path, darker[i].path) && darker[i].side == (lam_side)side ? darker[i].share : most;
        drawn++;
        if (share > most) {
            print_message("%s, %s: %.2f %% of the pixels are dark\n", path, lam_side_name((lam_side)side), 100 * share);
            failed++;
        }
    }
    lam_scene_free(scene);
}

static void walk(const char *folder)
{
    static const char *const ends[] = {".gltf", ".glb", ".obj", ".stl", ".ply", ".3mf"};
    struct dirent **names;
    int count = scandir(folder, &names, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        char path[1400];
        struct stat about;
        snprintf(path, sizeof path, "%s/%s", folder, names[i]->d_name);
        const char *end = strrchr(names[i]->d_name, '.');
        bool hidden = names[i]->d_name[0] == '.';
        if (!hidden && stat(path, &about) == 0 && S_ISDIR(about.st_mode))
            walk(path);
        for (size_t k = 0; !hidden && end && k < sizeof ends / sizeof *ends; k++)
            if (strcmp(end, ends[k]) == 0 && is_taken(seen++, 7))
                check_file(path);
        free(names[i]);
    }
    if (count >= 0)
        free(names);
}

TEST(no_side_is_black)
{
    const char *models = getenv("LAMBENT_MODELS");
    device = lam_device_cpu(NULL, NULL);
    assert_non_null(device);
    walk(models ? models : "../shared/models");
    lam_device_free(device);
    if (!seen) {
        print_message("the shared models are not there, so they are not tested\n");
        skip();
    }
    print_message("%d sides of %d files\n", drawn, (int)seen);
    assert_int_equal(failed, 0);
}
