// path_passes.c: draws path-traced light in passes of a few paths each. Each pixel of the picture is the mean of its
// passes, in a fixed order, so that a picture that stops after N paths has the bytes of the picture with N paths.
//
// Even and odd passes belong to two halves. The difference of the halves shows the noise: with A and B the means of the
// halves, the mean square of (A − B)/2 is the variance of (A + B)/2. It is measured in tiles, whose pixels are enough for
// a good estimate. Whether a tile is finished depends on its own paths alone.
#include "path_passes.h"

#define LANES 1
#include "lighting.h"
#include "picture_pixels.h"

#include "denoised.h"
#include "fail.h"
#include "linear.h"
#include "pixels.h"
#include "pool.h"

#include <stdlib.h>

// The paths of a pass. The noise of a tile is first estimated from four passes.
enum { PASS = 8, FIRST_PASSES = 4 };

bool path_passes_are_drawn(const struct frame *frame)
{
    return frame->settings.bounces && frame->settings.output == LAM_OUTPUT_PICTURE;
}

struct passes {
    struct lam_device *device;
    const lam_image *pass; // the picture of the last pass
    lam_image *light;
    double (*sums[2])[3]; // of each half, for each pixel
    int columns, tiles;
    int (*counts)[2]; // of each tile: the paths of each half
    bool *finished;
    float *noise; // of each tile: the variance, in squares of 1/255 of the encoded picture
    int half, paths;
};

static int at_most(int x, int most) { return x < most ? x : most; }

// Calls a function for each row of a tile, with the first pixel of the row and their number.
#define FOR_ROWS(p, tile, at, count)                                                                                   \
    for (int x_ = (int)(tile) % (p)->columns * FRAME_TILE, y_ = (int)(tile) / (p)->columns * FRAME_TILE,               \
             end_ = at_most(y_ + FRAME_TILE, (p)->light->height), count = at_most(FRAME_TILE, (p)->light->width - x_); \
         y_ < end_; y_++)                                                                                              \
        for (size_t once_ = 1, at = (size_t)y_ * (size_t)(p)->light->width + (size_t)x_; once_; once_ = 0)

static void add_tile(void *user, size_t tile, int thread)
{
    const struct passes *p = user;
    (void)thread;
    if (p->finished[tile])
        return;
    p->counts[tile][p->half] += p->paths;
    FOR_ROWS(p, tile, first, count)
    for (size_t at = first; at < first + (size_t)count; at++) {
        const float *pixel = (const float *)p->pass->pixels + 4 * at;
        for (int c = 0; c < 3; c++)
            p->sums[p->half][at][c] += (double)pixel[c] * p->paths;
        ((float *)p->light->pixels)[4 * at + 3] = pixel[3];
    }
}

// Returns the square of half the difference of the halves at a pixel, in the encoded picture.
static float variance_at(const struct passes *p, size_t tile, size_t at)
{
    float encoded[2][3], sum = 0, alpha = ((const float *)p->light->pixels)[4 * at + 3];
    for (int half = 0; half < 2; half++) {
        float mean[3];
        for (int c = 0; c < 3; c++)
            mean[c] = (float)(p->sums[half][at][c] / p->counts[tile][half]);
        struct frame own = {.exposure = 1, .settings.tone = p->device->frame.settings.tone}; // the light is exposed
        struct pixel_lanes out = toned(&own, (struct pixel_lanes){mean[0], mean[1], mean[2], alpha});
        encoded[half][0] = srgb_encode(out.r);
        encoded[half][1] = srgb_encode(out.g);
        encoded[half][2] = srgb_encode(out.b);
    }
    for (int c = 0; c < 3; c++) {
        float apart = 127.5f * (encoded[0][c] - encoded[1][c]);
        sum += apart * apart;
    }
    return sum * (1.0f / 3);
}

static void estimate_tile(void *user, size_t tile, int thread)
{
    const struct passes *p = user;
    const lam_draw_params *settings = &p->device->frame.settings;
    double sum = 0, pixels = 0;
    (void)thread;
    if (p->finished[tile])
        return;
    FOR_ROWS(p, tile, first, count)
    for (size_t at = first; at < first + (size_t)count; at++, pixels++)
        sum += (double)variance_at(p, tile, at);
    p->noise[tile] = (float)(sum / pixels);
    p->finished[tile] = settings->noise > 0 && p->counts[tile][1] >= FIRST_PASSES / 2 * PASS &&
                        p->noise[tile] <= settings->noise * settings->noise;
}

// Writes the mean of one half, or with −1 of both.
static void write_means(const struct passes *p, int half, lam_image *out)
{
    for (int tile = 0; tile < p->tiles; tile++)
        FOR_ROWS(p, tile, first, count)
    for (size_t at = first; at < first + (size_t)count; at++) {
        float *pixel = (float *)out->pixels + 4 * at;
        for (int c = 0; c < 3; c++)
            pixel[c] =
                half < 0 ? (float)((p->sums[0][at][c] + p->sums[1][at][c]) / (p->counts[tile][0] + p->counts[tile][1]))
                         : (float)(p->sums[half][at][c] / p->counts[tile][half]);
        pixel[3] = ((const float *)p->light->pixels)[4 * at + 3];
    }
}

// Sets the report, which contains the counts of all passes and the times of the last one. `times` are the times of all passes.
static void report_passes(const struct passes *p, int passes, const double times[4])
{
    lam_frame_report *report = &p->device->report;
    report->triangles_binned /= (uint64_t)passes;
    report->pixels_covered /= (uint64_t)passes;
    report->tiles_ms = times[0];
    report->coverage_ms = times[1];
    report->lighting_ms = times[2];
    report->resolve_ms = times[3];
    double paths = 0, noise = 0, pixels = (double)p->light->width * p->light->height;
    for (int tile = 0; tile < p->tiles; tile++) {
        double size = 0;
        FOR_ROWS(p, tile, first, count)
        size += first < SIZE_MAX ? count : 0;
        paths += size * (p->counts[tile][0] + p->counts[tile][1]);
        noise += size * (double)p->noise[tile];
    }
    report->paths = paths / pixels;
    report->noise = math_sqrt(noise / pixels);
}

// Draws passes until the picture has enough paths.
static bool draw_passes(struct passes *p, lam_image *pass, struct call_control *call, lam_error *error)
{
    struct frame *frame = &p->device->frame;
    const int all = frame->settings.paths, each = all < 2 * PASS ? (all + 1) / 2 : PASS;
    lam_frame_report *report = &p->device->report;
    uint64_t pair_start = now_ns();
    double times[4] = {0};
    bool ok = true, ends = false;
    int number = 0;
    report->triangles_binned = report->pixels_covered = report->points_lit = report->lights_evaluated = report->rays =
        0;
    call->part_rest = 1 - (double)each / all;
    for (int first = 0; first < all && ok && !ends; first += each, number++) {
        p->half = number & 1;
        p->paths = frame->settings.paths = all - first < each ? all - first : each;
        frame->path_first = first;
        frame->path_position = number / 2 * each; // the halves begin at the same positions: their edges are no noise
        call->part_begin = (double)first / all;
        ok = p->device->type->draw(p->device, frame, pass, call, error);
        if (!ok)
            break;
        times[0] += report->tiles_ms;
        times[1] += report->coverage_ms;
        times[2] += report->lighting_ms;
        times[3] += report->resolve_ms;
        pool_run(p->device->pool, (size_t)p->tiles, add_tile, p);
        if (!p->half)
            continue;
        pool_run(p->device->pool, (size_t)p->tiles, estimate_tile, p);
        ends = true;
        for (int tile = 0; tile < p->tiles; tile++)
            ends = ends && p->finished[tile];
        const double stop = (double)frame->settings.stop_after_s, now = (double)now_ns();
        ends |= stop > 0 && (now - (double)call->start_ns) + (now - (double)pair_start) > stop * 1e9;
        pair_start = now_ns();
    }
    call->part_begin = call->part_rest = 0;
    frame->settings.paths = all;
    frame->path_first = frame->path_position = 0;
    frame->finished_tiles = NULL;
    if (ok)
        report_passes(p, number, times);
    return ok;
}

bool path_passes_draw(struct lam_device *device, struct path_pictures *surfaces, lam_image *light,
                      struct call_control *call, lam_error *error)
{
    struct frame *frame = &device->frame;
    const size_t pixels = (size_t)light->width * (size_t)light->height;
    const int columns = (light->width + FRAME_TILE - 1) / FRAME_TILE,
              tiles = columns * ((light->height + FRAME_TILE - 1) / FRAME_TILE);
    struct passes p = {.device = device, .light = light, .columns = columns, .tiles = tiles};
    const size_t tile_bytes = sizeof *p.counts + sizeof *p.noise + sizeof *p.finished;
    const size_t bytes = pixels * (2 * sizeof *p.sums[0] + 16) + (size_t)tiles * tile_bytes;
    const lam_rgba background = frame->settings.background;
    lam_image pass = {0};
    double *memory = call_charge(call, bytes) ? calloc(1, bytes - 16 * pixels) : NULL;
    if (!memory)
        return call_memory_error(call, bytes, error);
    p.sums[0] = (double(*)[3])memory;
    p.sums[1] = p.sums[0] + pixels;
    p.counts = (int(*)[2])(p.sums[1] + pixels);
    p.noise = (float *)(p.counts + tiles);
    p.finished = (bool *)(p.noise + tiles);
    p.pass = &pass;
    frame->settings.background = (lam_rgba){0, 0, 0, 0};
    frame->finished_tiles = p.finished;
    bool ok =
        lam_image_make(&pass, light->width, light->height, LAM_RGBA32F, error) && draw_passes(&p, &pass, call, error);
    frame->settings.background = background;
    lam_image_free(&pass);
    const bool few = p.counts[0][0] + p.counts[0][1] < DENOISED_BELOW || frame->settings.denoise == LAM_DENOISE_ON;
    const bool filters = surfaces && p.counts[0][1] > 0 && few;
    for (int half = 0; half < 2 && ok && filters; half++) {
        ok = denoise_image_make(&surfaces->halves[half], light->width, light->height, call, error);
        if (ok)
            write_means(&p, half, &surfaces->halves[half]);
    }
    if (ok && !filters)
        write_means(&p, -1, light);
    free(memory);
    call_refund(call, bytes);
    return ok && (!filters || path_denoise(surfaces, light, device->pool, call, error));
}
