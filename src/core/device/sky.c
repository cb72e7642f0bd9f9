// sky.c: draws the environment behind a picture (lam_draw_params.background_environment), along the rays of the camera.
// All devices use this code: the device draws linear light over nothing, and this code adds the background. Light
// without noise (denoised.h) is drawn in the same way.
#include "sky.h"

#define LANES 1
#include "lighting.h"
#include "picture_pixels.h"

#include "path_passes.h"
#include "environment.h"
#include "fail.h"
#include "linear.h"
#include "pixels.h"
#include "pool.h"
#include "recorder.h"

// The largest number of rays per pixel, along each axis, and of directions that are looked up together.
enum { RAYS_MAX = 8, BATCH = 64 };

struct sky {
    const struct frame *frame;
    const struct environment_lookups *lookups;
    struct environment_view view;
    float level; // of the prefiltered environment
    int rays;    // per pixel, along each axis
    const lam_image *light;
    lam_image *target; // in a working format
};

bool sky_is_drawn(const struct frame *frame)
{
    return frame->settings.background_environment > 0 && output_is_picture(frame->settings.output);
}

// Computes the light of `count` pixels of row y, starting at column x: the mean over the rays of each pixel.
static void look(const struct sky *sky, int x, int y, int count, float out[3][BATCH])
{
    const struct frame *frame = sky->frame;
    float rows[3][BATCH], levels[BATCH], share = 1 / (float)(sky->rays * sky->rays);
    memset(out, 0, sizeof(float[3][BATCH]));
    for (int ray = 0; ray < sky->rays * sky->rays; ray++) {
        float right = ((float)(ray % sky->rays) + 0.5f) / (float)sky->rays,
              down = ((float)(ray / sky->rays) + 0.5f) / (float)sky->rays;
        for (int i = 0; i < count; i++) {
            bool parallel = frame->orthographic;
            rows[0][i] =
                parallel ? 0 : ((float)(x + i) + right - frame->middle[0]) * frame->pixel_size * frame->pixel_aspect;
            rows[1][i] = parallel ? 0 : (frame->middle[1] - ((float)y + down)) * frame->pixel_size;
            rows[2][i] = -1;
            levels[i] = sky->level;
        }
        float *const at[3] = {rows[0], rows[1], rows[2]};
        if (sky->level > 0)
            sky->lookups->prefiltered(&sky->view, at, levels, count, at);
        else
            sky->lookups->colors(&sky->view, at, count, at);
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < count; i++)
                out[c][i] += rows[c][i] * share;
    }
}

// Sets the colour that tinted glass shows where no surface is behind it: the mean over a grid of the picture's pixels.
static void set_glass(const struct sky *sky, struct frame *frame)
{
    enum { GRID = 4 };
    float light[3][BATCH], sum[3] = {0};
    for (int i = 0; i < GRID * GRID; i++) {
        look(sky, (2 * (i % GRID) + 1) * frame->width / (2 * GRID), (2 * (i / GRID) + 1) * frame->height / (2 * GRID),
             1, light);
        for (int c = 0; c < 3; c++)
            sum[c] += light[c][0];
    }
    for (int c = 0; c < 3; c++)
        frame->glass_background[c] = sum[c] / (GRID * GRID);
}

static bool prepare(struct sky *sky, struct frame *frame, struct pool *pool, struct call_control *call,
                    lam_error *error)
{
    *sky = (struct sky){.frame = frame};
    if (!sky_is_drawn(frame))
        return true;
    if (!frame->environment)
        return fail(error, LAM_BAD_ARGUMENT,
                    "background: no environment lights this scene; set one, such as studio, to show it");
    float blur = frame->settings.background_environment, level = prefilter_level(blur);
    *sky = (struct sky){.frame = frame, .lookups = environment_lookups_of(1), .level = level, .rays = 1};
    sky->view = (struct environment_view){.cube = frame->environment, .to_environment = frame->to_environment};
    // Several rays are averaged if a pixel is larger than a texel in the middle of a face.
    float texels = frame->pixel_size * (float)lam_environment_size(frame->environment) * 0.5f;
    if (!(level > 0) && !frame->orthographic && texels > 1)
        sky->rays = texels < RAYS_MAX ? (int)texels + 1 : RAYS_MAX;
    if (level > 0)
        sky->view.light =
            environment_light(frame->environment, environment_light_parts(level, level), pool, call, error);
    if (level > 0 && !sky->view.light)
        return false;
    set_glass(sky, frame);
    return true;
}

// Returns the background of a pixel: exposed, and toned if the picture is.
static lam_rgba background_of(const struct frame *frame, bool toned, const float light[3][BATCH], int i)
{
    vec3 c = {light[0][i] * frame->exposure, light[1][i] * frame->exposure, light[2][i] * frame->exposure};
    if (toned)
        c = tone_color(c, (int)frame->settings.tone);
    return (lam_rgba){c.x, c.y, c.z, 1};
}

static void compose_row(void *user, size_t row, int thread)
{
    (void)thread;
    const struct sky *sky = user;
    struct frame own = *sky->frame; // its background differs at each pixel
    own.exposure = 1;               // the light is already exposed
    size_t size = pixel_bytes(sky->target->format);
    const float *from = image_row(sky->light, (int)row);
    char *to = image_row(sky->target, (int)row);
    for (int x = 0; x < sky->light->width; x += BATCH) {
        float light[3][BATCH];
        int count = sky->light->width - x < BATCH ? sky->light->width - x : BATCH;
        if (sky->lookups)
            look(sky, x, (int)row, count, light);
        for (int i = 0; i < count; i++) {
            const float *p = from + 4 * (size_t)(x + i);
            if (sky->lookups)
                own.settings.background = background_of(sky->frame, sky->target->format == LAM_RGBA8, light, i);
            write_pixels(&own, (struct pixel_lanes){p[0], p[1], p[2], p[3]}, sky->target->format,
                         to + size * (size_t)(x + i), 1);
        }
    }
}

bool sky_draw(struct lam_device *device, struct path_pictures *denoised, lam_image *target, struct call_control *call,
              lam_error *error)
{
    struct frame *frame = &device->frame;
    struct sky sky;
    if (!prepare(&sky, frame, device->pool, call, error))
        return false;
    if (device->recorder && path_passes_are_drawn(frame))
        return path_bounces_record(device, target, call, error);
    if (device->recorder) { // only the recorded pixel matters
        float behind[3][BATCH];
        look(&sky, device->recorder->out->x, device->recorder->out->y, 1, behind);
        frame->settings.background = background_of(frame, target->format == LAM_RGBA8, behind, 0);
        return device->type->draw(device, frame, target, call, error);
    }
    const uint64_t bytes = 20 * (uint64_t)target->width * (uint64_t)target->height;
    if (!call_charge(call, bytes))
        return call_memory_error(call, bytes, error);
    lam_image light = {0};
    lam_image working = {.width = target->width, .height = target->height, .format = working_format(target->format)};
    bool direct = target->format == working.format;
    bool ok = lam_image_make(&light, target->width, target->height, LAM_RGBA32F, error) &&
              (direct || lam_image_make(&working, working.width, working.height, working.format, error)) &&
              (path_passes_are_drawn(frame) ? path_passes_draw(device, denoised, &light, call, error)
                                            : device->type->draw(device, frame, &light, call, error));
    sky.light = &light;
    sky.target = direct ? target : &working;
    if (ok)
        pool_run(device->pool, (size_t)light.height, compose_row, &sky);
    for (int y = 0; ok && !direct && y < target->height; y++)
        pixels_from_working(target->format, frame->settings.color == LAM_COLOR_RAW, image_row(&working, y),
                            target->width, image_row(target, y));
    lam_image_free(&light);
    lam_image_free(&working);
    return ok;
}
