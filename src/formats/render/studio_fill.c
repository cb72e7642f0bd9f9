// studio_fill.c: implements lam_studio_fill: adds a dim studio if a file's own lights leave most of the picture black.
#include "fail.h"
#include "linear.h"

#include <lambent/light.h>
#include <lambent/render.h>

#include <stdlib.h>

// BLACK is the luminance below which a pixel is treated as black. DARK is the luminance above which a surface would be
// visible if it were lit.
#define BLACK 0.01
#define DARK  0.05

enum { SIDE_MAX = 96 }; // the largest side of the measured pictures

static double luminance(const float *p)
{
    return 0.2126 * (double)p[0] + 0.7152 * (double)p[1] + 0.0722 * (double)p[2];
}

// Returns the fraction of the pixels that are black although their surface is not. If there is a ground, the pixels of
// the ground are also counted, because `lit` has a white background.
static double black_share(const lam_image *lit, const lam_image *surfaces, bool ground)
{
    size_t counted = 0, black = 0;
    for (size_t i = 0; i < (size_t)lit->width * (size_t)lit->height; i++) {
        const float *p = (const float *)lit->pixels + 4 * i, *q = (const float *)surfaces->pixels + 4 * i;
        bool model = q[3] > 0;
        counted += model || ground;
        black += (model ? luminance(q) > DARK : ground) && luminance(p) < BLACK;
    }
    return counted ? (double)black / (double)counted : 0;
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

// For each lit pixel, divides the luminance of the pixel by the luminance of the surface. Returns the upper quartile of
// these ratios. Returns 0 if no pixel is lit. The pixels of `lit` are overwritten.
static double lit_ratio(const lam_image *lit, const lam_image *surfaces)
{
    float *ratios = lit->pixels;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)lit->width * (size_t)lit->height; i++) {
        const float *p = (const float *)lit->pixels + 4 * i, *q = (const float *)surfaces->pixels + 4 * i;
        if (q[3] > 0 && luminance(q) > BLACK && luminance(p) >= BLACK)
            ratios[count++] = (float)(luminance(p) / luminance(q));
    }
    qsort(ratios, count, sizeof *ratios, by_size);
    return count ? (double)ratios[count * 3 / 4] : 0;
}

struct lighting {
    double black_share; // −1: the pictures could not be drawn
    double lit_ratio;
};

// Draws two pictures: the lit scene, and the colours of its surfaces. Returns the results of black_share and lit_ratio.
static struct lighting measure(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                               const lam_draw_params *params, int width, int height, const lam_control *control,
                               lam_error *error)
{
    bool ground = params->ground != LAM_GROUND_NONE;
    lam_draw_params drawn = *params;
    drawn.background = ground ? (lam_rgba){1, 1, 1, 1} : (lam_rgba){0, 0, 0, 0};
    drawn.background_environment = 0;
    drawn.samples = 1;
    drawn.wireframe = drawn.no_surfaces = false;
    drawn.edges = 0;
    int longer = width > height ? width : height;
    width = longer > SIDE_MAX ? (int)((int64_t)width * SIDE_MAX / longer) : width;
    height = longer > SIDE_MAX ? (int)((int64_t)height * SIDE_MAX / longer) : height;
    lam_image lit = {0}, surfaces = {0};
    bool ok = lam_image_make(&lit, width > 0 ? width : 1, height > 0 ? height : 1, LAM_RGBA32F, error) &&
              lam_image_make(&surfaces, lit.width, lit.height, LAM_RGBA32F, error) &&
              lam_draw(device, scene, camera, &drawn, &lit, control, error);
    drawn.output = LAM_OUTPUT_BASE_COLOR;
    drawn.background = (lam_rgba){0, 0, 0, 0};
    drawn.ground = LAM_GROUND_NONE;
    ok = ok && lam_draw(device, scene, camera, &drawn, &surfaces, control, error);
    struct lighting measured = {-1, 0};
    if (ok) {
        measured.black_share = black_share(&lit, &surfaces, ground);
        measured.lit_ratio = lit_ratio(&lit, &surfaces);
    }
    lam_image_free(&lit);
    lam_image_free(&surfaces);
    return measured;
}

static lam_rgb times(lam_rgb c, double factor)
{
    return (lam_rgb){(float)((double)c.r * factor), (float)((double)c.g * factor), (float)((double)c.b * factor)};
}

// Multiplies the intensity of the scene's lights by a factor.
static bool scale_lights(lam_scene *scene, double factor, lam_error *error)
{
    for (int i = 0; i < lam_scene_light_count(scene); i++) {
        lam_light light = *lam_scene_light(scene, i);
        lam_rgb *colors[] = {&light.ambient, &light.diffuse, &light.specular, &light.sky, &light.ground};
        for (size_t k = 0; k < sizeof colors / sizeof *colors; k++)
            *colors[k] = times(*colors[k], factor);
        if (!lam_scene_set_light(scene, i, &light, error))
            return false;
    }
    return true;
}

bool lam_studio_fill(lam_device *device, lam_scene *scene, const lam_camera *camera, lam_draw_params *params, int width,
                     int height, const lam_control *control, double *light_scale, lam_error *error)
{
    if (!device || !scene || !camera || !params || !light_scale)
        return fail(error, LAM_BAD_ARGUMENT, "lam_studio_fill: an argument is NULL");
    *light_scale = 0;
    // Only physical reflection models use the light of an environment.
    bool classic = params->reflection != LAM_REFLECTION_AUTO && params->reflection < LAM_REFLECTION_COUNT &&
                   !lam_reflection_describe(params->reflection)->microfacet;
    if (classic || params->output != LAM_OUTPUT_PICTURE || lam_scene_environment(scene))
        return true;
    struct lighting measured = measure(device, scene, camera, params, width, height, control, error);
    if (measured.black_share < 0)
        return false;
    if (measured.black_share <= 0.1)
        return true;
    // With this scale, the lit surfaces remain as bright as before the change of the exposure, or become darker if they
    // were too bright.
    double scale =
        math_exp2(params->exposure - LAM_STUDIO_FILL_EXPOSURE) / (measured.lit_ratio > 1 ? measured.lit_ratio : 1);
    lam_environment *studio = lam_environment_built_in("studio", error);
    bool ok = studio && lam_scene_set_reflection_map(scene, studio, 0, error) && scale_lights(scene, scale, error);
    lam_environment_free(studio);
    if (!ok)
        return false;
    // The warning is the same for every view, because it does not contain the measured share. A scene reports equal
    // warnings only once.
    lam_scene_add_warning(scene, "the file's own lights leave much of the picture black, so a dim studio also lights "
                                 "the model (the rig 'file' uses only the file's lights)");
    params->exposure = LAM_STUDIO_FILL_EXPOSURE;
    *light_scale = scale;
    return true;
}
