// picture_pixels.h: converts linear light to the pixels of a picture, LANES pixels at a time. Composites the light over
// the background and encodes it. All devices use this code. Define LANES before including this file (lanes.h).
#ifndef PICTURE_PIXELS_H
#define PICTURE_PIXELS_H

#include "frame.h"

#include "encoding.h"
#include "prelude_c.h"
#include "tone.h"

#include <string.h>

struct pixel_lanes {
    num r, g, b, a;
};

// Applies the exposure to a sum of premultiplied colours.
LANE_FN struct pixel_lanes exposed(const struct frame *frame, struct pixel_lanes p)
{
    return (struct pixel_lanes){p.r * frame->exposure, p.g * frame->exposure, p.b * frame->exposure, p.a};
}

// Applies the exposure and the frame's tone curve to a sum of premultiplied colours. The result is premultiplied, too.
LANE_FN struct pixel_lanes toned(const struct frame *frame, struct pixel_lanes p)
{
    num part = pick(p.a > 0.0f, frame->exposure / p.a, num_of(0.0f));
    vec3 c = tone_color(vec3_of(p.r * part, p.g * part, p.b * part), (int)frame->settings.tone);
    return (struct pixel_lanes){c.x * p.a, c.y * p.a, c.z * p.a, p.a};
}

// Composites premultiplied colours, exposed or toned, over the background.
LANE_FN struct pixel_lanes over_background(const struct frame *frame, struct pixel_lanes p)
{
    const lam_rgba *back = &frame->settings.background;
    num clear = 1.0f - p.a;
    p.r = p.r + clear * (back->r * back->a);
    p.g = p.g + clear * (back->g * back->a);
    p.b = p.b + clear * (back->b * back->a);
    p.a = p.a + clear * back->a;
    return p;
}

LANE_FN num straight_channel(num x, num a) { return pick(a > 0.0f, x / a, num_of(0.0f)); }
LANE_FN num encoded_channel(num straight, int raw) { return raw ? saturate(straight) : srgb_encode(straight); }

// Converts a premultiplied channel to a byte: divides it by alpha, encodes and rounds it.
LANE_FN inum to_byte(num x, num a, int raw)
{
    return int_of(encoded_channel(straight_channel(x, a), raw) * 255.0f + 0.5f);
}

LANE_FN inum to_rgba8(const struct frame *frame, struct pixel_lanes p)
{
    int raw = frame->settings.color == LAM_COLOR_RAW;
    inum r = to_byte(p.r, p.a, raw), g = to_byte(p.g, p.a, raw), b = to_byte(p.b, p.a, raw);
    inum a = int_of(saturate(p.a) * 255.0f + 0.5f);
    return r | shift_left(g, 8) | shift_left(b, 16) | shift_left(a, 24);
}

// Works like to_rgba8, for opaque pixels, which hide the background. The results are equal, because dividing by an
// alpha of 1 is exact.
LANE_FN inum opaque_to_rgba8(const struct frame *frame, struct pixel_lanes p)
{
    int raw = frame->settings.color == LAM_COLOR_RAW;
    num one = num_of(1.0f);
    inum r = to_byte(p.r * frame->exposure, one, raw), g = to_byte(p.g * frame->exposure, one, raw);
    inum b = to_byte(p.b * frame->exposure, one, raw);
    return r | shift_left(g, 8) | shift_left(b, 16) | inum_of((int32_t)0xff000000);
}

// Writes the first `count` of LANES pixels of 4 bytes.
LANE_FN void write_packed(inum pixels, void *to, int count)
{
    if (count == LANES) {
        inum_store(to, pixels);
        return;
    }
    int32_t packed[LANES];
    inum_store(packed, pixels);
    memcpy(to, packed, (size_t)count * 4);
}

// Writes the first `count` pixels of a vector to the picture.
LANE_FN void write_pixels(const struct frame *frame, struct pixel_lanes p, lam_pixel_format format, void *to, int count)
{
    if (format == LAM_RGBA8 && frame->settings.tone != LAM_TONE_NONE) {
        write_packed(to_rgba8(frame, over_background(frame, toned(frame, p))), to, count);
        return;
    }
    if (format == LAM_RGBA8 && all_lanes(p.a == 1.0f)) {
        write_packed(opaque_to_rgba8(frame, p), to, count);
        return;
    }
    p = over_background(frame, exposed(frame, p));
    if (format == LAM_RGBA8) {
        write_packed(to_rgba8(frame, p), to, count);
        return;
    }
    float r[LANES], g[LANES], b[LANES], a[LANES], *out = to;
    num_store(r, p.r);
    num_store(g, p.g);
    num_store(b, p.b);
    num_store(a, p.a);
    for (int i = 0; i < count; i++) {
        out[4 * i] = r[i];
        out[4 * i + 1] = g[i];
        out[4 * i + 2] = b[i];
        out[4 * i + 3] = a[i];
    }
}

#endif
