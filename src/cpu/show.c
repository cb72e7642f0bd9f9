// show.c: pixels that hold numbers of the surfaces in place of colours: what stands for a pixel, and its code
// in 8 bits (lam_show in lambent/device.h says both). Plain C: every instruction set has the same.
#include "kernels.h"

#include <string.h>

static float held(float x, float low, float high) { return x > high ? high : x > low ? x : low; } // NaN: low

static uint8_t byte_of(float x) { return (uint8_t)(held(x, 0, 1) * 255.0f + 0.5f); }

// A colour that tells neighbouring triangles apart; 48 and more, so that it stands out from black.
static void color_of_ids(const float v[3], uint8_t out[4])
{
    uint64_t h = ((uint64_t)v[1] << 40 | (uint64_t)v[2] << 24 | (uint64_t)v[0]) + 1;
    h *= UINT64_C(0x9e3779b97f4a7c15);
    h = (h ^ h >> 29) * UINT64_C(0xd6e8feb86659fd93);
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)(48 + (h >> (40 + 8 * c) & 0xff) * 207 / 255);
}

// The code of a covered pixel's numbers.
static void encode(const struct frame *frame, const float v[4], uint8_t out[4])
{
    static const uint8_t front[3] = {0, 102, 255}, back[3] = {255, 51, 0};
    out[3] = 255;
    switch (frame->show) {
    case LAM_SHOW_IDS:
        color_of_ids(v, out);
        return;
    case LAM_SHOW_FACING:
        memcpy(out, v[0] > 0 ? front : back, 3);
        return;
    default:
        break;
    }
    for (int c = 0; c < 3; c++)
        switch (frame->show) {
        case LAM_SHOW_NORMALS:
        case LAM_SHOW_TANGENTS:
            out[c] = byte_of((v[c] + 1.0f) * 0.5f);
            break;
        case LAM_SHOW_DEPTH:
            out[c] = byte_of((frame->far_plane - v[c]) / (frame->far_plane - frame->near_plane));
            break;
        case LAM_SHOW_OVERDRAW:
            out[c] = byte_of(v[c] / (v[c] + 3.0f));
            break;
        default: // cosines, coverage
            out[c] = byte_of(v[c]);
        }
}

static void put(const struct cpu_frame *cpu, const float v[4], void *to)
{
    if (cpu->image->format == LAM_RGBA32F)
        memcpy(to, v, 16);
    else if (v[3] > 0)
        encode(cpu->frame, v, to);
    else
        memset(to, 0, 4);
}

// Each pixel's number is its first fragment's: the one with the covered sample nearest to the centre
// (fragments.c).
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
        thread->sum[0][thread->fragment_pixel[i]] +=
            (float)thread->fragment_weight[i] / (float)cpu->frame->samples;
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

// How far the picture's pixel leaves 0…1, or its mark in 8 bits.
static void put_clipped(const struct cpu_frame *cpu, const float p[4], void *to)
{
    float out[4] = {0}, straight[3];
    bool above = false, below = false;
    for (int c = 0; c < 3; c++) {
        straight[c] = p[3] > 0 ? p[c] / p[3] : 0;
        out[c] = straight[c] - held(straight[c], 0, 1);
        above |= out[c] > 0;
        below |= out[c] < 0;
    }
    out[3] = p[3] > 0 ? 1 : 0;
    if (cpu->image->format == LAM_RGBA32F) {
        memcpy(to, out, 16);
        return;
    }
    uint8_t grey = byte_of((straight[0] + straight[1] + straight[2]) * (0.5f / 3.0f));
    uint8_t code[4] = {above   ? 255
                       : below ? 0
                               : grey,
                       above || below ? 0 : grey,
                       above   ? 0
                       : below ? 255
                               : grey,
                       p[3] > 0 ? 255 : 0};
    memcpy(to, code, 4);
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

void show_tile(const struct cpu_frame *cpu, struct thread_state *thread, int tile_x, int tile_y, int width,
               int height)
{
    lam_show show = cpu->frame->show;
    bool of_pixels = show == LAM_SHOW_COVERAGE || show == LAM_SHOW_OVERDRAW;
    if (show == LAM_SHOW_CLIPPED) {
        resolve_apart(cpu, thread, width, height);
    } else {
        for (int c = 0; c < 4; c++)
            memset(thread->sum[c], 0, TILE * TILE * sizeof(float));
        if (show == LAM_SHOW_COVERAGE)
            sum_coverage(cpu, thread);
        else if (show == LAM_SHOW_OVERDRAW)
            sum_overdraw(cpu, thread, width, height);
        else
            pick_fragments(thread);
    }
    lam_image *image = cpu->image;
    size_t size = image->format == LAM_RGBA8 ? 4 : 16;
    for (int y = 0; y < height; y++) {
        char *row =
            (char *)image->pixels +
            (((size_t)tile_y * TILE + (size_t)y) * (size_t)image->width + (size_t)tile_x * TILE) * size;
        for (int x = 0; x < width; x++, row += size) {
            int at = y * TILE + x;
            float first = thread->sum[0][at];
            if (show == LAM_SHOW_CLIPPED)
                put_clipped(cpu, thread->shown + 4 * ((size_t)y * (size_t)width + (size_t)x), row);
            else if (of_pixels)
                put(cpu, (float[4]){first, first, first, 1}, row);
            else
                put(cpu, (float[4]){first, thread->sum[1][at], thread->sum[2][at], thread->sum[3][at]}, row);
        }
    }
}

void show_empty(struct cpu_frame *cpu)
{
    lam_show show = cpu->frame->show;
    if (show == LAM_SHOW_CLIPPED) {
        const lam_rgba *b = &cpu->frame->background;
        put_clipped(cpu, (float[4]){b->r * b->a, b->g * b->a, b->b * b->a, b->a}, cpu->empty_pixel);
        return;
    }
    put(cpu, (float[4]){0, 0, 0, show == LAM_SHOW_COVERAGE || show == LAM_SHOW_OVERDRAW ? 1.0f : 0.0f},
        cpu->empty_pixel);
}
