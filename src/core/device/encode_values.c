// encode_values.c: writes pixels that contain surface properties instead of colours, in the 8-bit encoding that
// lam_output in lambent/device.h defines. All devices use this plain C code.
#include "encode_values.h"

#define LANES 4
#include "picture_pixels.h"

#include <string.h>

// Returns `low` for NaN.
static float clamped(float x, float low, float high) { return x > high ? high : x > low ? x : low; }

static uint8_t code_byte(float x) { return (uint8_t)(clamped(x, 0, 1) * 255.0f + 0.5f); }

// Returns a colour that distinguishes neighbouring triangles. Each channel is at least 48, so that the colour differs
// from black.
static void color_of_ids(const float v[3], uint8_t out[4])
{
    uint64_t h = ((uint64_t)v[1] << 40 | (uint64_t)v[2] << 24 | (uint64_t)v[0]) + 1;
    h *= UINT64_C(0x9e3779b97f4a7c15);
    h = (h ^ h >> 29) * UINT64_C(0xd6e8feb86659fd93);
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)(48 + (h >> (40 + 8 * c) & 0xff) * 207 / 255);
}

// Returns 1 for the depth of the scene's nearest vertex, and 0 for its farthest vertex. If the depths differ by less
// than their rounding error, the whole scene is treated as nearest.
static float depth_code(const struct frame *frame, float depth)
{
    float far = frame->depth_far, range = far - frame->depth_near;
    return range > 1e-5f * (far < 0 ? -far : far) ? (far - depth) / range : 1;
}

// Returns the label of a part, from the values of LAM_OUTPUT_IDS.
static float part_label(const struct frame *frame, const float v[3])
{
    const int object = (int)v[1];
    const uint32_t triangle = (uint32_t)v[2] << 24 | (uint32_t)v[0];
    int low = 0, high = frame->draw_count - 1;
    while (low < high) { // draws are in the order of their objects; the ground, with object −1, is last
        const int middle = (low + high) / 2, there = frame->draws[middle].object;
        if (there >= 0 && there < object)
            low = middle + 1;
        else
            high = middle;
    }
    const struct frame_draw *draw = &frame->draws[low];
    if (draw->object != object || object < 0)
        return 0;
    uint32_t part = 0;
    while (!draw->strokes && part + 1 < draw->mesh->part_count && // parts of a mesh are few
           triangle - draw->mesh->parts[part].first_triangle >= draw->mesh->parts[part].triangle_count)
        part++;
    return (float)(draw->first_part + (int)part + 1);
}

// Converts the values of the output that the device drew (output_row.drawn) to the output that was asked for.
static void convert(const struct frame *frame, const float v[4], float out[4])
{
    memcpy(out, v, 4 * sizeof *out);
    if (frame->shown == LAM_OUTPUT_NORMALS_WORLD) {
        for (int i = 0; i < 3; i++)
            out[i] = (frame->to_world[i][0] * v[0] + frame->to_world[i][1] * v[1]) + frame->to_world[i][2] * v[2];
    } else if (frame->shown == LAM_OUTPUT_OBJECT_ID || frame->shown == LAM_OUTPUT_PART_ID) {
        out[0] = frame->shown == LAM_OUTPUT_PART_ID ? part_label(frame, v) : v[1] + 1;
        out[1] = out[2] = out[0];
    }
}

// Encodes the values in 8 bits.
static void encode(const struct frame *frame, const float v[4], uint8_t out[4])
{
    static const uint8_t front[3] = {0, 102, 255}, back[3] = {255, 51, 0};
    const enum output_code code = output_rows[frame->shown].code;
    out[3] = 255;
    if (code == CODE_IDS)
        color_of_ids(v, out);
    else if (code == CODE_LABEL)
        color_of_ids((float[3]){v[0], 0, 0}, out);
    else if (code == CODE_SIDES)
        memcpy(out, v[0] > 0 ? front : back, 3);
    else
        for (int c = 0; c < 3; c++)
            out[c] = code_byte(code == CODE_SIGNED  ? (v[c] + 1.0f) * 0.5f
                               : code == CODE_DEPTH ? depth_code(frame, v[c])
                               : code == CODE_COLOR
                                   ? lane(encoded_channel(num_of(v[c]), frame->settings.color == LAM_COLOR_RAW), 0)
                               : code == CODE_LEVEL    ? v[c] * 0.1f
                               : code == CODE_OVERDRAW ? v[c] / (v[c] + 3.0f)
                                                       : v[c]);
}

void encode_values(const struct frame *frame, lam_pixel_format format, const float v[4], void *to)
{
    float shown[4];
    convert(frame, v, shown);
    if (format == LAM_RGBA32F)
        memcpy(to, shown, 16);
    else
        encode(frame, shown, to);
}

void encode_empty(const struct frame *frame, lam_pixel_format format, void *to)
{
    const lam_rgba *b = &frame->settings.background;
    num zero = num_of(0.0f);
    if (frame->settings.output == LAM_OUTPUT_CLIPPED)
        encode_clipped(format, (float[4]){b->r * b->a, b->g * b->a, b->b * b->a, b->a}, to);
    else if (output_kind(frame->settings.output) == OUTPUT_COUNT)
        encode_values(frame, format, (float[4]){0, 0, 0, 1}, to);
    else if (format == LAM_RGBA32F)
        memset(to, 0, 16);
    else
        write_pixels(frame, (struct pixel_lanes){zero, zero, zero, zero}, format, to, 1);
}

// Writes the amount by which each channel of the pixel is outside 0…1. In an 8-bit format, writes a marker colour
// instead.
void encode_clipped(lam_pixel_format format, const float p[4], void *to)
{
    float out[4] = {0}, straight[3];
    bool above = false, below = false;
    for (int c = 0; c < 3; c++) {
        straight[c] = p[3] > 0 ? p[c] / p[3] : 0;
        out[c] = straight[c] - clamped(straight[c], 0, 1);
        above |= out[c] > 0;
        below |= out[c] < 0;
    }
    out[3] = p[3] > 0 ? 1 : 0;
    if (format == LAM_RGBA32F) {
        memcpy(to, out, 16);
        return;
    }
    uint8_t grey = code_byte((straight[0] + straight[1] + straight[2]) * (0.5f / 3.0f));
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
