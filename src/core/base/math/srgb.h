// srgb.h: converts sRGB-encoded numbers to linear light.
#ifndef SRGB_H
#define SRGB_H

#include <stdint.h>

// Decodes an sRGB-encoded number (0…1) to linear light (0…1), as defined by IEC 61966-2-1. The result is accurate to a
// few units in the last place of a double. NaN and negative numbers give 0, and the curve continues for numbers above
// 1. This function is for set-up work; image/encoding.h contains functions that convert many floats at a time.
double srgb_linear(double encoded);

// Returns the byte whose linear light is closest to `linear`.
uint8_t srgb_byte(double linear);

#endif
