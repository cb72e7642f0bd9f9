// exposure.c: finds the exposure that suits a frame, from the luminance of its covered pixels.
#include "fail.h"
#include "float_state.h"
#include "linear.h"

#include <lambent/device.h>

#include <stdlib.h>

// The target luminance, and the share of the pixels that should be at most this bright.
#define TARGET 0.8
#define SHARE  0.95

enum { SIDE_MAX = 512 }; // the largest side of the measured picture

static int ascending(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

// Replaces a picture of premultiplied floats by the luminances (BT.709) of its covered pixels. Returns the number of
// these pixels.
static size_t luminances(lam_image *image)
{
    float *pixels = image->pixels;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++) {
        const float *p = pixels + 4 * i;
        if (!(p[3] > 0))
            continue;
        float luminance = ((0.2126f * p[0] + 0.7152f * p[1]) + 0.0722f * p[2]) / p[3];
        pixels[count++] = luminance > 0 ? luminance : 0; // count <= i
    }
    return count;
}

// Rounds the factor TARGET / luminance to thirds of a stop.
static double stops_for(double luminance)
{
    int thirds = -300, last = 300;
    double wanted = TARGET / luminance;
    while (thirds < last && math_exp2((thirds + 0.5) / 3) < wanted)
        thirds++;
    return thirds / 3.0;
}

bool lam_exposure_fit(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                      const lam_draw_params *params, int width, int height, const lam_control *control, double *stops,
                      lam_error *error)
{
    if (!stops)
        return fail(error, LAM_BAD_ARGUMENT, "lam_exposure_fit: stops is NULL");
    *stops = 0;
    lam_draw_params drawn = {0};
    if (params)
        drawn = *params;
    drawn.background = (lam_rgba){0, 0, 0, 0};
    drawn.background_environment = 0;
    drawn.exposure = 0;
    drawn.samples = 1;
    drawn.output = LAM_OUTPUT_PICTURE;
    drawn.light_cutoff = -1;
    drawn.ground = LAM_GROUND_NONE;
    drawn.shadows |= params && params->ground; // a ground plane receives shadows
    drawn.wireframe = drawn.no_surfaces = false;
    drawn.edges = 0;
    lam_camera smaller = *camera;
    if (!camera->width) {
        smaller.width = width;
        smaller.height = height;
    }
    int longer = width > height ? width : height;
    if (longer > SIDE_MAX) {
        width = (int)((int64_t)width * SIDE_MAX / longer);
        height = (int)((int64_t)height * SIDE_MAX / longer);
    }
    lam_image image = {0};
    if (!lam_image_make(&image, width > 0 ? width : 1, height > 0 ? height : 1, LAM_RGBA32F, error))
        return false;
    bool ok = lam_draw(device, scene, &smaller, &drawn, &image, control, error);
    size_t count = ok ? luminances(&image) : 0;
    if (count) {
        float *values = image.pixels;
        qsort(values, count, sizeof *values, ascending);
        size_t at = (size_t)((double)(count - 1) * SHARE + 0.5);
        uint64_t state = float_state_enter();
        if (values[at] > 0)
            *stops = stops_for((double)values[at]);
        float_state_leave(state);
    }
    lam_image_free(&image);
    return ok;
}
