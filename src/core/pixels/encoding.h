// encoding.h: converts linear light to sRGB and back (IEC 61966-2-1), and converts numbers to bytes, LANES values at a
// time (lanes.h).
//
// For numbers in 0…1, both curves differ by at most 1e-6 from the standard's formulas. Numbers outside this range are
// clamped, and NaN becomes 0. If a byte is decoded and encoded again, the result is the same byte.
#ifndef ENCODING_H
#define ENCODING_H

#include "functions.h"

// Encodes linear 0…1: 12.92·x up to 0.0031308, then 1.055·x^(1/2.4) − 0.055.
LANE_FN num srgb_encode(num linear)
{
    num x = saturate(linear);
    num curve = exp2_of(log2_of(x) * 0.416666667f);
    return pick(x <= 0.0031308f, 12.92f * x, curve + 0.055f * (curve - 1.0f)); // this form maps 1 to exactly 1
}

// Decodes 0…1 to linear 0…1: x/12.92 up to 0.04045, then ((x + 0.055)/1.055)^2.4.
LANE_FN num srgb_decode(num encoded)
{
    num x = saturate(encoded);
    num base = 1.0f + (x - 1.0f) * 0.947867299f; // (x + 0.055)/1.055, in a form that maps 1 to exactly 1
    return pick(x <= 0.04045f, x * 0.0773993808f, exp2_of(log2_of(base) * 2.4f));
}

// Converts 0…1 to 0…255: floor(255·x + ½). Numbers outside this range are clamped, and NaN becomes 0.
LANE_FN inum byte_of(num x) { return int_of(saturate(x) * 255.0f + 0.5f); }

#endif
