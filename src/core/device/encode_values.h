// encode_values.h: writes pixels that contain surface properties instead of colours (lam_output).
#ifndef ENCODE_VALUES_H
#define ENCODE_VALUES_H

#include "frame.h"

// Writes a pixel with the values v: a surface property, coverage or overdraw.
void encode_values(const struct frame *frame, lam_pixel_format format, const float v[4], void *to);

// Writes a pixel that no triangle covers. Coverage, overdraw and clipping have values for such pixels. For other
// outputs, writes the background in 8-bit formats, and 0 in float formats.
void encode_empty(const struct frame *frame, lam_pixel_format format, void *to);

// Writes the amount by which each channel of the pixel p (premultiplied) is outside 0…1. In an 8-bit format, writes a
// marker colour instead.
void encode_clipped(lam_pixel_format format, const float p[4], void *to);

// Returns whether 8-bit pixels of this frame store values without the sRGB encoding.
static inline bool values_are_raw(const struct frame *frame)
{
    bool color = lam_output_is_light(frame->settings.output) || frame->settings.output == LAM_OUTPUT_BASE_COLOR;
    return frame->settings.color == LAM_COLOR_RAW || !color;
}

#endif
