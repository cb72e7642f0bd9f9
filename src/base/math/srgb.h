// srgb.h: converts sRGB-encoded numbers to linear light.
#ifndef SRGB_H
#define SRGB_H

// Decodes an sRGB-encoded number to linear light (IEC 61966-2-1), 0…1 for 0…1, accurate to a few units in a double's
// last place. NaN and negative numbers give 0, and numbers above 1 continue along the curve. It is for set-up work;
// image/encoding.h contains the curves for many floats at a time.
double srgb_linear(double encoded);

#endif
