// eights.h: vectors of eight floats, independent of LANES. These vectors are for data structures that are the same on
// all instruction sets and are read eight floats at a time. As in lanes.h, all operations are correctly rounded and
// written with C operators.
#ifndef EIGHTS_H
#define EIGHTS_H

#include "lanes.h"

typedef float eight __attribute__((vector_size(32)));
typedef float eight_memory __attribute__((vector_size(32), aligned(4), may_alias));

typedef int32_t eight_bits __attribute__((vector_size(32)));

LANE_FN eight eight_of(float x) { return x - (eight){0}; }
LANE_FN eight eight_absolute(eight x) { return (eight)((eight_bits)x & INT32_MAX); }
LANE_FN eight eight_load(const float *at) { return (eight) * (const eight_memory *)at; }

// The minimum and maximum are defined like min_of and max_of in lanes.h. eight_not_above returns a bit mask: bit i is
// set if a ≤ b in lane i.
#if defined(__AVX__)
LANE_FN eight eight_min(eight a, eight b) { return (eight)_mm256_min_ps((__m256)a, (__m256)b); }
LANE_FN eight eight_max(eight a, eight b) { return (eight)_mm256_max_ps((__m256)a, (__m256)b); }
LANE_FN unsigned eight_not_above(eight a, eight b)
{
    return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LE_OQ));
}
#elif defined(__SSE2__)
union eight_halves {
    eight all;
    __m128 half[2];
};
LANE_FN eight eight_min(eight a, eight b)
{
    union eight_halves x = {a}, y = {b};
    for (int i = 0; i < 2; i++)
        x.half[i] = _mm_min_ps(x.half[i], y.half[i]);
    return x.all;
}
LANE_FN eight eight_max(eight a, eight b)
{
    union eight_halves x = {a}, y = {b};
    for (int i = 0; i < 2; i++)
        x.half[i] = _mm_max_ps(x.half[i], y.half[i]);
    return x.all;
}
LANE_FN unsigned eight_not_above(eight a, eight b)
{
    union eight_halves x = {a}, y = {b};
    return (unsigned)_mm_movemask_ps(_mm_cmple_ps(x.half[0], y.half[0])) |
           (unsigned)_mm_movemask_ps(_mm_cmple_ps(x.half[1], y.half[1])) << 4;
}
#else
LANE_FN eight eight_min(eight a, eight b)
{
    for (int i = 0; i < 8; i++)
        a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
}
LANE_FN eight eight_max(eight a, eight b)
{
    for (int i = 0; i < 8; i++)
        a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
}
LANE_FN unsigned eight_not_above(eight a, eight b)
{
    unsigned bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (unsigned)(a[i] <= b[i]) << i;
    return bits;
}
#endif

// Returns a bit mask: bit i is set if lane i has the bits of `number`.
LANE_FN unsigned eight_same(eight a, int32_t number)
{
    return eight_not_above(eight_absolute(__builtin_convertvector((eight_bits)a ^ number, eight)), eight_of(0));
}

#endif
