// output.c: writes pixels with surface properties instead of colours (lam_output in lambent/device.h). This file is
// plain C, compiled once for all instruction sets.
#include "output.h"

#include "encode_values.h"

#include <string.h>

// A pixel's value is the value of its first fragment, which is at the covered sample nearest to the centre
// (visibility_resolve.inc).
static void pick_fragments(const struct fragments *fragments, float *const sum[4])
{
    int before = -1;
    for (int i = 0; i < fragments->count; i++) {
        int pixel = fragments->pixel[i];
        if (pixel == before)
            continue;
        before = pixel;
        for (int c = 0; c < 3; c++)
            sum[c][pixel] = fragments->color[c][i];
        sum[3][pixel] = 1;
    }
}

static void sum_coverage(const struct fragments *fragments, int samples, float *sum)
{
    for (int i = 0; i < fragments->count; i++)
        sum[fragments->pixel[i]] += (float)fragments->weight[i] / (float)samples;
}

static void sum_overdraw(const int32_t *counts, int samples, const struct tile *tile, float *sum)
{
    struct cells cells = cells_of(samples);
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++) {
            const int32_t *pixel = counts + pixel_index(&cells, x, y);
            uint64_t total = 0;
            for (int i = 0; i < samples; i++)
                total += (uint64_t)pixel[i];
            sum[y * TILE + x] = (float)((double)total / samples);
        }
}

void output_tile(const struct resolve_target *target, const struct fragments *fragments,
                 const struct tile_samples *samples, struct pixel_sums *sums, const struct tile *tile)
{
    const struct frame *frame = target->frame;
    lam_output output = frame->settings.output;
    bool of_pixels = output_kind(output) == OUTPUT_COUNT;
    float *const *sum = sums->sum;
    if (output != LAM_OUTPUT_CLIPPED)
        for (int c = 0; c < 4; c++)
            memset(sum[c], 0, TILE * TILE * sizeof(float));
    if (output == LAM_OUTPUT_COVERAGE)
        sum_coverage(fragments, frame->settings.samples, sum[0]);
    else if (output == LAM_OUTPUT_OVERDRAW)
        sum_overdraw(samples->counts, frame->settings.samples, tile, sum[0]);
    else if (output != LAM_OUTPUT_CLIPPED)
        pick_fragments(fragments, sum);
    lam_pixel_format format = target->image->format;
    for (int y = 0; y < tile->height; y++) {
        char *to = tile_row(target->image, tile, y);
        for (int x = 0; x < tile->width; x++, to += working_bytes(target->image)) {
            int at = y * TILE + x;
            float first = sum[0][at];
            if (output == LAM_OUTPUT_CLIPPED)
                encode_clipped(format, sums->unclipped + 4 * ((size_t)y * (size_t)tile->width + (size_t)x), to);
            else if (of_pixels)
                encode_values(frame, format, (float[4]){first, first, first, 1}, to);
            else if (sum[3][at] > 0)
                encode_values(frame, format, (float[4]){first, sum[1][at], sum[2][at], 1}, to);
            else
                memcpy(to, target->empty_pixel, working_bytes(target->image));
        }
    }
}

void output_empty(struct resolve_target *target)
{
    encode_empty(target->frame, target->image->format, target->empty_pixel);
}
