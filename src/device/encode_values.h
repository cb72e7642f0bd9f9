// encode_values.h: writes pixels that contain surface properties instead of colours (lam_output).
#ifndef ENCODE_VALUES_H
#define ENCODE_VALUES_H

#include "frame.h"

// Writes a pixel with the values v: a surface property, coverage or overdraw.
void encode_values(const struct frame *frame, lam_pixel_format format, const float v[4], void *to);

// Writes a pixel without a triangle: the background in 8 bits, 0 in floats, or its coverage, overdraw or excess.
void encode_empty(const struct frame *frame, lam_pixel_format format, void *to);

// Writes the excess of the picture's pixel p (premultiplied) over 0…1, or in 8 bits a colour that marks it.
void encode_clipped(lam_pixel_format format, const float p[4], void *to);

// Returns whether 8 bits store numbers that are not sRGB-encoded.
static inline bool values_are_raw(const struct frame *frame)
{
    bool color = lam_output_is_light(frame->settings.output) || frame->settings.output == LAM_OUTPUT_BASE_COLOR;
    return frame->settings.color == LAM_COLOR_RAW || !color;
}

#endif
