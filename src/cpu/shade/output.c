// output.c: pixels that hold numbers of the surfaces in place of colours: what stands for a pixel (lam_output in
// lambent/device.h). Plain C: every instruction set has the same.
#include "kernels.h"
#include "encode_values.h"

#include <string.h>

// Each pixel's number is its first fragment's: the one with the covered sample nearest to the centre (visibility_resolve.inc).
static void pick_fragments(struct thread_state *thread)
{
    int before = -1;
    for (int i = 0; i < thread->fragment_count; i++) {
        int pixel = thread->fragment_pixel[i];
        if (pixel == before)
            continue;
        before = pixel;
        for (int c = 0; c < 3; c++)
            thread->sum[c][pixel] = thread->fragment_color[c][i];
        thread->sum[3][pixel] = 1;
    }
}

static void sum_coverage(const struct cpu_frame *cpu, struct thread_state *thread)
{
    for (int i = 0; i < thread->fragment_count; i++)
        thread->sum[0][thread->fragment_pixel[i]] += (float)thread->fragment_weight[i] / (float)cpu->frame->samples;
}

static void sum_overdraw(const struct cpu_frame *cpu, struct thread_state *thread, int width, int height)
{
    int samples = cpu->frame->samples;
    struct cells cells = cells_of(samples);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const int32_t *counts = thread->counts + pixel_place(&cells, x, y);
            uint64_t sum = 0;
            for (int i = 0; i < samples; i++)
                sum += (uint64_t)counts[i];
            thread->sum[0][y * TILE + x] = (float)((double)sum / samples);
        }
}

// The tile as the picture would have it, in floats.
static void resolve_apart(const struct cpu_frame *cpu, struct thread_state *thread, int width, int height)
{
    lam_image part = {width, height, LAM_RGBA32F, thread->shown};
    struct cpu_frame copy = *cpu;
    copy.image = &part;
    cpu->kernels->resolve_empty(&copy);
    cpu->kernels->resolve(&copy, thread, 0, 0);
}

void show_tile(const struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y, int width, int height)
{
    lam_output show = cpu->frame->show;
    bool of_pixels = show == LAM_OUTPUT_COVERAGE || show == LAM_OUTPUT_OVERDRAW;
    if (show == LAM_OUTPUT_CLIPPED) {
        resolve_apart(cpu, thread, width, height);
    } else {
        for (int c = 0; c < 4; c++)
            memset(thread->sum[c], 0, TILE * TILE * sizeof(float));
        if (show == LAM_OUTPUT_COVERAGE)
            sum_coverage(cpu, thread);
        else if (show == LAM_OUTPUT_OVERDRAW)
            sum_overdraw(cpu, thread, width, height);
        else
            pick_fragments(thread);
    }
    lam_image *image = cpu->image;
    size_t size = image->format == LAM_RGBA8 ? 4 : 16;
    for (int y = 0; y < height; y++) {
        char *row = (char *)image->pixels +
                    (((size_t)tile_y * TILE + (size_t)y) * (size_t)image->width + (size_t)tile_x * TILE) * size;
        for (int x = 0; x < width; x++, row += size) {
            int at = y * TILE + x;
            float first = thread->sum[0][at];
            if (show == LAM_OUTPUT_CLIPPED)
                shown_put_clipped(cpu->image->format, thread->shown + 4 * ((size_t)y * (size_t)width + (size_t)x), row);
            else if (of_pixels)
                shown_put(cpu->frame, cpu->image->format, (float[4]){first, first, first, 1}, row);
            else
                shown_put(cpu->frame, cpu->image->format,
                          (float[4]){first, thread->sum[1][at], thread->sum[2][at], thread->sum[3][at]}, row);
        }
    }
}

void show_empty(struct cpu_frame *cpu)
{
    lam_output show = cpu->frame->show;
    if (show == LAM_OUTPUT_CLIPPED) {
        const lam_rgba *b = &cpu->frame->background;
        shown_put_clipped(cpu->image->format, (float[4]){b->r * b->a, b->g * b->a, b->b * b->a, b->a},
                          cpu->empty_pixel);
        return;
    }
    shown_put(cpu->frame, cpu->image->format,
              (float[4]){0, 0, 0, show == LAM_OUTPUT_COVERAGE || show == LAM_OUTPUT_OVERDRAW ? 1.0f : 0.0f},
              cpu->empty_pixel);
}
