// encode_values.h: what a picture's pixel holds where it shows numbers in place of colours.
#ifndef ENCODE_VALUES_H
#define ENCODE_VALUES_H

#include "frame.h"

// A pixel with the numbers v, covered where v[3] is above 0.
void shown_put(const struct frame *frame, lam_pixel_format format, const float v[4], void *to);

// How far the picture's pixel p, premultiplied, leaves 0…1, or its mark in 8 bits.
void shown_put_clipped(lam_pixel_format format, const float p[4], void *to);

#endif
