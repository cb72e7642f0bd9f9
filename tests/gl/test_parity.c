// test_parity.c: compares the OpenGL device with the CPU device over all demonstration scenes at one sample, in OpenGL
// 3.3 and OpenGL ES 3.0. It is longer than 600 lines because every allowed difference has its own test.
//
// In 8 bits, at least 99.9 % of the pixels differ by at most 1/255, and no pixel outside the mask differs by more than
// 2/255. In floats, pixels outside the mask differ by at most 5e-4·max(1, value). The mask consists of the pixels whose
// 3×3 neighbourhood contains, in the CPU device's own values, more than one object, more than one facing, a step in
// depth, a change in the number of translucent layers, or the edge of a spot's cone or of a hard shadow, and of the
// pixels with translucent layers or a checker that change when the eye moves by the step that corners are snapped to:
// there two rasterizers may legitimately differ. In soft shadows, and where rays
// graze edges of translucent surfaces, 0.02 % of the pixels may count one point of one light more or less.
// The mask covers at most 5 % of the covered pixels of all scenes; the test reports its size. A failure writes NAME.gl.png
// (or NAME.gles.png) and NAME.cpu.png to the working directory.
//
// `make test` draws the scenes in OpenGL 3.3 and OpenGL ES 3.0 alternately; the test long-gl-parity draws each in both.
//
// The file is longer than 600 lines because all scenes share the bounds and the mask.
#include "card.h"
#include "context.h"
#include "linear.h"
#include "scenes.h"
#include "share.h"

#include <lambent/light.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Larger pictures, in which edges are a smaller fraction of the pixels; smaller if a software driver takes seconds for
// each.
enum { SCALE = 4, SLOW_SCALE = 2 };
static const char *const slow[] = {"shadows-soft", "ground-shadow", "shadows-leaves"};

static int scale_of(const char *name)
{
    for (size_t i = 0; i < sizeof slow / sizeof *slow; i++)
        if (strcmp(name, slow[i]) == 0)
            return SLOW_SCALE;
    return SCALE;
}

// Scenes that need wider bounds because of the precision of floats.
static const struct {
    const char *name;
    double floats;
    // Surfaces are closer to each other than the precision of depth values: only the bound for 99.9 % of the pixels applies.
    bool ambiguous;
    // A triangle seen almost from its edge. Its corners snapped to 1/256 pixel form another triangle, over which OpenGL
    // interpolates; the CPU device interpolates over the triangle that is not snapped. A pixel may differ by the change
    // of the CPU device's own value when the eye moves by such a step.
    bool snapped;
    // Lights with a size: in their penumbra, every pixel is at the edge of the shadow from some point of the light. A
    // few pixels may count one point of one light more or less.
    bool soft;
    // Rays that graze the edge of a hole, or of a triangle that transmits light; in floats, a ray may pass on the other
    // side. It counts like such a point.
    bool grazing;
    // The edge of a hidden surface covers a sample on one device only, which changes the occlusion of a few pixels.
    bool hidden;
} loose[] = {
    // A square of 40 000 units: floats have a precision of 0.002 there, and the light is at a distance of 4. A ball
    // touches it at a place where depth values have a step of 0.0004 with a near plane of 0.01.
    {"ground", .floats = 2e-3, .ambiguous = true},
    // Lamps more than 100 times as bright as their neighbourhood, with edges of four texels, amplify rounding errors of
    // directions.
    {"mirror-studio", .floats = 3e-3},
    // Ambient occlusion is computed from differences of distances, and amplifies their rounding errors: a sample at an
    // edge is on one surface or the other. On models with flat faces, the third power of cavity shading amplifies them.
    {"planes", .floats = 5e-3},
    {"cylinder", .floats = 1e-2},
    {"two-sides-mirrored", .floats = 6e-3},
    {"culled-front", .floats = 5e-2, .hidden = true},
    {"inside", .floats = 3e-3},
    {"translucent", .floats = 8e-3},
    {"lines", .floats = 5e-2, .hidden = true},
    {"teapot", .floats = 2e-2, .hidden = true},
    {"cone", .floats = 2e-2, .hidden = true},
    {"one-side", .floats = 2e-3},
    {"stretched", .floats = 2e-3},
    {"slivers", .floats = 1e-2},
    {"metaballs", .floats = 2e-3},
    {"two-sides", .floats = 6e-3},
    {"orthographic", .floats = 5e-3},
    {"intersecting", .floats = 2e-3},
    // The cavity has a radius of few pixels, and amplifies these errors more. So does the key light of curved models,
    // which occlusion dims completely.
    {"gyroid", .floats = 6e-3},
    {"ground-checker", .floats = 5e-3, .soft = true},
    {"samples-1", .floats = 3.5e-3},
    {"samples-2", .floats = 3.5e-3},
    {"samples-4", .floats = 3.5e-3},
    {"samples-8", .floats = 3.5e-3},
    {"samples-16", .floats = 3.5e-3},
    {"environment-light", .floats = 1.5e-2},
    {"environment-classic", .floats = 1.5e-2, .hidden = true},
    {"shadows-soft", .floats = 5e-4, .soft = true},
    {"ground-shadow", .floats = 1e-3, .soft = true},
    {"masked", .floats = 5e-4, .snapped = true},
    {"shadows-leaves", .floats = 5e-4, .grazing = true},
    {"layers", .floats = 5e-4, .snapped = true},
    {"layers-transmission", .floats = 5e-4, .snapped = true},
    {"layers-gouraud", .floats = 5e-4, .snapped = true},
    {"layers-environment", .floats = 1.5e-2, .snapped = true},
};

static bool depth_is_ambiguous(const char *name)
{
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        if (strcmp(name, loose[i].name) == 0)
            return loose[i].ambiguous;
    return false;
}

static bool is_snapped(const char *name)
{
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        if (strcmp(name, loose[i].name) == 0)
            return loose[i].snapped;
    return false;
}

static bool is_grazing(const char *name)
{
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        if (strcmp(name, loose[i].name) == 0)
            return loose[i].grazing;
    return false;
}

static bool is_hidden(const char *name)
{
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        if (strcmp(name, loose[i].name) == 0)
            return loose[i].hidden;
    return false;
}

static bool is_soft(const char *name)
{
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        if (strcmp(name, loose[i].name) == 0)
            return loose[i].soft;
    return false;
}

static double float_limit(const char *name)
{
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        if (strcmp(name, loose[i].name) == 0)
            return loose[i].floats;
    return 5e-4;
}

static lam_device *cpu;
static lam_device *gl[2]; // OpenGL 3.3 core, OpenGL ES 3.0; NULL: not available
static uint64_t pixels_of_table, covered_of_table, masked_of_table;

static void draw(lam_device *device, const struct demo *demo, const lam_draw_params *params, lam_pixel_format format,
                 lam_image *image)
{
    lam_error error = {0};
    *image = (lam_image){0};
    if (!lam_image_make(image, demo->width, demo->height, format, &error) ||
        !lam_draw(device, demo->scene, &demo->camera, params, image, NULL, &error))
        fail_msg("%s", error.text);
}

// Draws an output with the CPU device, as floats.
static lam_image draw_output(const struct demo *demo, lam_output show, int light)
{
    lam_draw_params params = demo->params;
    params.samples = 1;
    params.output = show;
    params.output_light = light;
    lam_image image;
    draw(cpu, demo, &params, LAM_RGBA32F, &image);
    return image;
}

// --- the mask

struct mask {
    int width, height;
    uint8_t *out; // 1: masked
};

typedef bool differ_fn(const float *a, const float *b, double limit);

static bool differ_first(const float *a, const float *b, double limit)
{
    (void)limit;
    return a[0] != b[0] || (a[3] > 0) != (b[3] > 0);
}
static bool differ_object(const float *a, const float *b, double limit)
{
    (void)limit;
    return a[1] != b[1] || (a[3] > 0) != (b[3] > 0);
}
static bool differ_dark(const float *a, const float *b, double limit)
{
    (void)limit;
    bool lit_a = a[0] + a[1] + a[2] > 0, lit_b = b[0] + b[1] + b[2] > 0;
    return a[3] > 0 && b[3] > 0 && lit_a != lit_b;
}

// The edge of a shadow that transmits light.
static bool differ_step(const float *a, const float *b, double limit)
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += a[c] < b[c] ? b[c] - a[c] : a[c] - b[c];
    return a[3] > 0 && b[3] > 0 && sum > limit;
}

// Masks the pixels that differ from a pixel of their 3×3 neighbourhood.
static void mask_where(struct mask *mask, lam_image *image, differ_fn *differ, double limit)
{
    const float *p = image->pixels;
    for (int y = 0; y < mask->height; y++)
        for (int x = 0; x < mask->width; x++) {
            bool found = false;
            const float *first = p + 4 * ((size_t)y * (size_t)mask->width + (size_t)x);
            for (int dy = -1; dy <= 1; dy++)
                for (int dx = -1; dx <= 1; dx++) {
                    int nx = x + dx, ny = y + dy;
                    if (nx >= 0 && ny >= 0 && nx < mask->width && ny < mask->height)
                        found |= differ(first, p + 4 * ((size_t)ny * (size_t)mask->width + (size_t)nx), limit);
                }
            mask->out[(size_t)y * (size_t)mask->width + (size_t)x] |= found;
        }
    lam_image_free(image);
}

// Returns the size of a pixel at the mean depth.
static double pixel_size(const struct demo *demo, const lam_image *depth)
{
    double sum = 0, count = 0;
    const float *p = depth->pixels;
    for (size_t i = 0; i < (size_t)depth->width * (size_t)depth->height; i++)
        if (p[4 * i + 3] > 0) {
            sum += (double)p[4 * i];
            count++;
        }
    double half = demo->camera.ortho_half_height > 0
                      ? demo->camera.ortho_half_height
                      : (count > 0 ? sum / count : 0) * __builtin_tan(demo->camera.fovy_rad / 2);
    return 2 * half / demo->height;
}

// Masks steps in depth: three consecutive pixels whose second difference exceeds `limit`.
static void mask_steps(struct mask *mask, lam_image *image, double limit)
{
    const float *p = image->pixels;
    size_t row = (size_t)mask->width;
    for (int y = 0; y < mask->height; y++)
        for (int x = 0; x < mask->width; x++)
            for (int along = 0; along < 2; along++) {
                if (along ? y < 1 || y + 1 >= mask->height : x < 1 || x + 1 >= mask->width)
                    continue;
                size_t at = (size_t)y * row + (size_t)x, step = along ? row : 1;
                const float *a = p + 4 * (at - step), *b = p + 4 * at, *c = p + 4 * (at + step);
                double bend = (double)a[0] - 2 * (double)b[0] + (double)c[0];
                if (a[3] > 0 && b[3] > 0 && c[3] > 0 && (bend < 0 ? -bend : bend) > limit)
                    mask->out[at - step] = mask->out[at] = mask->out[at + step] = 1;
            }
    lam_image_free(image);
}

static int byte_difference(const uint8_t *a, const uint8_t *b)
{
    int max = 0;
    for (int c = 0; c < 4; c++)
        max = abs(a[c] - b[c]) > max ? abs(a[c] - b[c]) : max;
    return max;
}

// A scene whose eye is moved by 1/256 pixel, along one of the picture's four half diagonals.
static struct demo moved_eye(const struct demo *demo, double pixel, int way)
{
    struct demo moved = *demo;
    moved.params.samples = 1;
    lam_vec3 z = v3_sub(demo->camera.target, demo->camera.eye), right = v3_unit(v3_cross(z, demo->camera.up));
    lam_vec3 up = v3_unit(v3_cross(right, z));
    double step = pixel / 256;
    lam_vec3 by = v3_add(v3_scale(right, way & 1 ? step : -step), v3_scale(up, way & 2 ? step : -step));
    moved.camera.eye = v3_add(demo->camera.eye, by);
    moved.camera.target = v3_add(demo->camera.target, by);
    return moved;
}

// Masks the pixels that change after such a movement of the eye. If two surfaces intersect behind a translucent one,
// snapping determines which is nearer.
static void mask_unstable(struct mask *mask, const struct demo *demo, double pixel)
{
    lam_image still, image;
    struct demo moved = *demo;
    moved.params.samples = 1;
    draw(cpu, demo, &moved.params, LAM_RGBA8, &still);
    for (int i = 0; i < 4; i++) {
        moved = moved_eye(demo, pixel, i);
        draw(cpu, &moved, &moved.params, LAM_RGBA8, &image);
        for (size_t n = 0; n < (size_t)mask->width * (size_t)mask->height; n++)
            mask->out[n] |=
                byte_difference((const uint8_t *)still.pixels + 4 * n, (const uint8_t *)image.pixels + 4 * n) > 2;
        lam_image_free(&image);
    }
    lam_image_free(&still);
}

static struct mask mask_of(const struct demo *demo, bool soft)
{
    struct mask mask = {.width = demo->width, .height = demo->height};
    mask.out = calloc((size_t)mask.width * (size_t)mask.height, 1);
    lam_image image = draw_output(demo, LAM_OUTPUT_IDS, 0);
    mask_where(&mask, &image, differ_object, 0);
    image = draw_output(demo, LAM_OUTPUT_FACING, 0);
    mask_where(&mask, &image, differ_first, 0);
    image = draw_output(demo, LAM_OUTPUT_DEPTH, 0);
    double size = pixel_size(demo, &image);
    mask_steps(&mask, &image, 4 * size);
    bool translucent = false;
    for (int i = 0; i < lam_scene_material_count(demo->scene); i++)
        translucent |= lam_scene_material(demo->scene, i)->diffuse.a < 1 ||
                       lam_scene_material(demo->scene, i)->alpha_mode == LAM_ALPHA_MASK;
    for (int i = 0; lam_scene_mesh(demo->scene, i); i++)
        translucent |= lam_scene_mesh(demo->scene, i)->colors_format == LAM_COLORS_LINEAR_F32;
    if (translucent) {
        image = draw_output(demo, LAM_OUTPUT_OVERDRAW, 0);
        mask_where(&mask, &image, differ_first, 0);
        mask_unstable(&mask, demo, size);
    }
    if (demo->params.ground == LAM_GROUND_CHECKER) // edges of squares, which are not edges of objects
        mask_unstable(&mask, demo, size);
    static lam_light lights[4096];
    int count = lam_draw_lights(demo->scene, demo->params.rig, demo->params.ground, lights, 4096);
    for (int i = 0; i < count && count <= 16 && demo->params.reflection != LAM_REFLECTION_NONE; i++) {
        bool casts =
            demo->params.shadows && lights[i].type != LAM_LIGHT_AMBIENT && lights[i].type != LAM_LIGHT_HEMISPHERE;
        if (lights[i].type != LAM_LIGHT_SPOT && (!casts || soft)) // the edges of soft shadows are counted instead
            continue;
        image = draw_output(demo, LAM_OUTPUT_LIGHT, i);
        mask_where(&mask, &image, casts && translucent ? differ_step : differ_dark, 0.1);
    }
    return mask;
}

// --- the comparison

struct outcome {
    uint64_t pixels, covered, masked, over_1, over_2_outside, snapped, grain, soft, between;
    double worst_outside, worst_float, worst_between;
};

static struct outcome worst[2];
static const char *worst_name[2];

static double float_difference(const float *a, const float *b)
{
    double max = 0;
    for (int c = 0; c < 4; c++) {
        double d = (double)a[c] - (double)b[c], size = (double)b[c] < 0 ? -(double)b[c] : (double)b[c];
        d = (d < 0 ? -d : d) / (size > 1 ? size : 1);
        max = d > max ? d : max;
    }
    return max;
}

// The CPU device's pictures of a scene.
struct reference {
    struct mask mask;
    lam_image bytes, floats, ids;
    lam_image moved[4]; // moved by a step of the eye; empty if the scene does not allow this
};

// The change of the CPU device's own value of a pixel by a step of the eye.
static double own_change(const struct reference *r, uint64_t pixel)
{
    double max = 0;
    for (int i = 0; i < 4 && r->moved[i].pixels; i++) {
        const float *a = (const float *)r->moved[i].pixels + 4 * pixel,
                    *b = (const float *)r->floats.pixels + 4 * pixel;
        double change = float_difference(a, b);
        max = change > max ? change : max;
    }
    return max;
}

// Whether all channels of `value` are between the values of the CPU device's 3×3 neighbourhood of a pixel: the two
// devices then differ in the exact position of an edge inside the picture, for example of a lamp in a mirror.
static bool is_between(const struct demo *demo, const struct reference *r, uint64_t pixel, const float *value)
{
    int x = (int)(pixel % (uint64_t)demo->width), y = (int)(pixel / (uint64_t)demo->width);
    for (int c = 0; c < 4; c++) {
        float low = INFINITY, high = -INFINITY;
        for (int j = y - 1; j <= y + 1; j++)
            for (int i = x - 1; i <= x + 1; i++)
                if (i >= 0 && i < demo->width && j >= 0 && j < demo->height) {
                    float v = ((const float *)r->floats.pixels)[4 * (j * demo->width + i) + c];
                    low = v < low ? v : low;
                    high = v > high ? v : high;
                }
        if (value[c] < low - 1e-4f || value[c] > high + 1e-4f)
            return false;
    }
    return true;
}

// Pixels whose difference results from the snapping of corners; a few at most.
static const uint64_t max_snapped = 4;
// The largest difference in a penumbra (docs/lighting/shadows.md); at most 1 % of the pixels may differ by more than 1/255.
static const double max_penumbra = 6.0 / 255;

// On a graphics card up to 0.3 % of the pixels may lie between their neighbours, floats may differ by five times as much, and twice as
// many pixels by 1/255: the bounds of docs/opengl.md.
static bool is_good(const struct outcome *o, lam_device *device, const char *name)
{
    bool card = is_card(lam_device_name(device));
    bool hidden = is_hidden(name);
    return (double)o->over_2_outside <= (hidden ? 5e-4 * (double)o->pixels : 0) &&
           o->worst_outside <= (hidden ? 10 : 255) && (card || o->snapped <= max_snapped) && o->worst_between <= 8 &&
           (double)o->between <= 3e-3 * (double)o->pixels && (double)o->soft <= 0.01 * (double)o->pixels &&
           (double)o->grain <= (card ? 1e-3 : 2e-4) * (double)o->pixels &&
           (double)o->over_1 <= (card || hidden ? 0.002 : 0.001) * (double)o->pixels &&
           o->worst_float <= (card ? 5 : 1) * float_limit(name);
}

static void save(const lam_image *image, const char *name, const char *by)
{
    char path[128];
    lam_error error;
    snprintf(path, sizeof path, "%s.%s.png", name, by);
    if (!lam_image_save(image, path, NULL, &error))
        print_message("%s\n", error.text);
}

static double soft_samples(const lam_draw_params *params)
{
    return params->shadow_samples ? params->shadow_samples : 128;
}

static struct outcome compare(lam_device *device, const struct demo *demo, const lam_draw_params *params,
                              const struct reference *reference, const char *name)
{
    struct outcome o = {.pixels = (uint64_t)demo->width * (uint64_t)demo->height};
    lam_image bytes, floats;
    draw(device, demo, params, LAM_RGBA8, &bytes);
    draw(device, demo, params, LAM_RGBA32F, &floats);
    const uint8_t *a = reference->bytes.pixels, *b = bytes.pixels;
    const float *c = reference->floats.pixels, *d = floats.pixels;
    for (uint64_t i = 0; i < o.pixels; i++) {
        bool covered = ((const float *)reference->ids.pixels)[4 * i + 3] > 0, masked = reference->mask.out[i];
        int apart = byte_difference(a + 4 * i, b + 4 * i);
        double far = float_difference(d + 4 * i, c + 4 * i);
        o.covered += covered;
        o.masked += covered && masked;
        if (is_soft(name) && soft_samples(params) > 48 &&
            far <= max_penumbra) { // the CPU device shares rays between pixels
            o.soft += apart > 1;
            continue;
        }
        o.over_1 += apart > 1;
        if (masked || (apart > 2 && depth_is_ambiguous(name)))
            continue;
        if (far > float_limit(name) && far <= own_change(reference, i)) {
            o.snapped++;
            continue;
        }
        if (is_card(lam_device_name(device)) && (far > float_limit(name) || apart > 2)) {
            bool between = is_between(demo, reference, i, d + 4 * i);
            if (between || (apart <= 8 && o.snapped < max_snapped)) {
                o.between += between;
                o.snapped += !between;
                o.worst_between = apart > o.worst_between ? apart : o.worst_between;
                continue;
            }
        }
        if (far > float_limit(name) && (is_grazing(name) || (is_soft(name) && far <= 1.0 / soft_samples(params)))) {
            o.grain++;
            continue;
        }
        o.over_2_outside += apart > 2;
        o.worst_outside = apart > o.worst_outside ? apart : o.worst_outside;
        o.worst_float = far > o.worst_float ? far : o.worst_float;
    }
    bool good = is_good(&o, device, name);
    if (!good) {
        save(&reference->bytes, name, "cpu");
        save(&bytes, name, device == gl[0] ? "gl" : "gles");
    }
    lam_image_free(&bytes);
    lam_image_free(&floats);
    print_message("%-28s %-4s %s %6.3f %% over 1/255, worst outside %g/255, %.1e in floats, mask %4.1f %% of covered, "
                  "%llu pixels by a point of a light, %llu between their neighbours (at most %g/255)\n",
                  name, device == gl[0] ? "3.3" : "ES", good ? "  " : "!!", 100.0 * (double)o.over_1 / (double)o.pixels,
                  o.worst_outside, o.worst_float, o.covered ? 100.0 * (double)o.masked / (double)o.covered : 0,
                  (unsigned long long)o.grain, (unsigned long long)o.between, o.worst_between);
    return o;
}

// Features of only the CPU device are refused with an error message, and the device still draws.
static void check_refused(const struct demo *demo, const char *reason)
{
    bool scene = strstr(reason, "glass"); // a property of the scene, not of the settings

    for (int i = 0; i < 2; i++) {
        lam_error error = {0};
        lam_image image = {0};
        if (!gl[i])
            continue;
        assert_true(lam_image_make(&image, demo->width, demo->height, LAM_RGBA8, &error));
        assert_false(lam_draw(gl[i], demo->scene, &demo->camera, &demo->params, &image, NULL, &error));
        assert_int_equal(error.code, LAM_UNSUPPORTED);
        assert_non_null(strstr(error.text, reason));
        lam_draw_params params = demo->params;
        params.reference = params.bounces = 0;
        if (scene || demo->params.bounces) // glass is opaque there
            params.shading = LAM_SHADING_GOURAUD;
        params.occlusion = LAM_OCCLUSION_AUTO;
        params.ground = params.shading == LAM_SHADING_GOURAUD ? LAM_GROUND_NONE : params.ground;
        if (!lam_draw(gl[i], demo->scene, &demo->camera, &params, &image, NULL, &error))
            fail_msg("%s", error.text);
        lam_image_free(&image);
    }
}

static void check_scene(void **state)
{
    const struct demo_row *row = *state;
    struct demo demo;
    lam_error error = {0};
    if (!gl[0] && !gl[1])
        skip();
    if (!demo_build(row, &demo, &error))
        fail_msg("%s: %s", row->name, error.text);
    const char *reason = demo.params.reference                         ? "reference is 100"
                         : demo.params.bounces                         ? "bounces is"
                         : demo.params.occlusion == LAM_OCCLUSION_RAYS ? "'rays'"
                         : strcmp(row->name, "layers-refraction") == 0 ? "rough or thick glass"
                                                                       : NULL;
    if (reason) {
        check_refused(&demo, reason);
        lam_scene_free(demo.scene);
        return;
    }
    demo.width *= scale_of(row->name);
    demo.height *= scale_of(row->name);
    lam_draw_params params = demo.params;
    params.samples = 1;
    struct reference drawn = {.mask = mask_of(&demo, is_soft(row->name)), .ids = draw_output(&demo, LAM_OUTPUT_IDS, 0)};
    draw(cpu, &demo, &params, LAM_RGBA8, &drawn.bytes);
    draw(cpu, &demo, &params, LAM_RGBA32F, &drawn.floats);
    if (is_snapped(row->name)) {
        lam_image depth = draw_output(&demo, LAM_OUTPUT_DEPTH, 0);
        for (int i = 0; i < 4; i++) {
            struct demo moved = moved_eye(&demo, pixel_size(&demo, &depth), i);
            draw(cpu, &moved, &moved.params, LAM_RGBA32F, &drawn.moved[i]);
        }
        lam_image_free(&depth);
    }
    bool good = true;
    for (int i = 0; i < 2; i++) {
        if (!gl[i] || (gl[!i] && !is_taken((size_t)(row - demos) + (size_t)i, 2)))
            continue;
        struct outcome o = compare(gl[i], &demo, &params, &drawn, row->name);
        good &= is_good(&o, gl[i], row->name);
        pixels_of_table += o.pixels;
        covered_of_table += o.covered;
        masked_of_table += o.masked;
        if (!worst_name[i] || o.worst_float > worst[i].worst_float) {
            worst[i] = o;
            worst_name[i] = row->name;
        }
    }
    lam_image_free(&drawn.bytes);
    lam_image_free(&drawn.floats);
    lam_image_free(&drawn.ids);
    for (int i = 0; i < 4; i++)
        lam_image_free(&drawn.moved[i]);
    free(drawn.mask.out);
    lam_scene_free(demo.scene);
    assert_true(good);
}

static void check_mask(void **state)
{
    (void)state;
    if (!gl[0] && !gl[1])
        skip();
    double share = (double)masked_of_table / (double)covered_of_table;
    for (int i = 0; i < 2; i++)
        if (gl[i] && worst_name[i])
            print_message("%s: largest difference in floats: %s, %.1e\n", lam_device_name(gl[i]), worst_name[i],
                          worst[i].worst_float);
    print_message("the mask: %.2f %% of the covered pixels of the table\n", 100 * share);
    assert_true(share <= 0.05);
}

// Arguments: the scenes to compare, instead of all.
int main(int argc, char **argv)
{
    lam_error error = {0};
    cpu = lam_device_cpu(NULL, &error);
    for (int i = 0; i < 2; i++) {
        lam_gl_params params = {.api = i ? LAM_GL_ES : LAM_GL_CORE, .debug = true};
        gl[i] = lam_device_gl(&params, &error);
        print_message("%s\n", gl[i] ? lam_device_name(gl[i]) : error.text);
    }
    struct CMUnitTest *tests = calloc((size_t)demo_count + 1, sizeof *tests);
    size_t count = 0;
    for (int i = 0; i < demo_count; i++) {
        bool wanted = argc < 2 && (is_more() || is_taken((size_t)i, 3));
        for (int k = 1; k < argc; k++)
            wanted |= strcmp(argv[k], demos[i].name) == 0;
        if (wanted)
            tests[count++] = (struct CMUnitTest){demos[i].name, check_scene, NULL, NULL, (void *)(uintptr_t)&demos[i]};
    }
    if (count == (size_t)demo_count) // its fraction applies to the whole table
        tests[count++] = (struct CMUnitTest){"the mask is small", check_mask, NULL, NULL, NULL};
    int failed = _cmocka_run_group_tests("gl-parity", tests, count, NULL, NULL);
    free(tests);
    lam_device_free(gl[0]);
    lam_device_free(gl[1]);
    lam_device_free(cpu);
    return failed;
}
