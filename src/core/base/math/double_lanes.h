// double_lanes.h: vectors of doubles that correspond to the floats of lanes.h.
//
//  dnum   DLANES doubles in one register, half as many as a num has floats
//  dmask  DLANES truth values, the results of comparisons
//
// As in lanes.h, only + − × ÷ and comparisons are used. Each operation is correctly rounded, so the results are
// bit-identical for every width. One vector twice as wide as a register could replace the two vectors, but compilers
// would then use scalar instructions for comparisons.
#ifndef DOUBLE_LANES_H
#define DOUBLE_LANES_H

#include "lanes.h"

#if LANES == 1
#define DLANES 1
typedef double dnum;
typedef int64_t dmask; // 0 or 1
#else
#define DLANES (LANES / 2)
typedef double dnum __attribute__((vector_size(DLANES * 8)));
typedef int64_t dmask __attribute__((vector_size(DLANES * 8))); // each lane is 0 or −1
typedef double dnum_memory __attribute__((vector_size(DLANES * 8), aligned(8), may_alias));
#endif

#if LANES == 1
LANE_FN dnum dabsolute(dnum x) { return __builtin_fabs(x); }
LANE_FN void dnum_store_float(float *at, dnum x) { *at = (float)x; }
LANE_FN dnum dnum_of(double x) { return x; }
LANE_FN dnum dnum_load(const double *at) { return *at; }
LANE_FN dnum dnum_load_float(const float *at) { return (double)*at; }
LANE_FN void dnum_store(double *at, dnum x) { *at = x; }
LANE_FN dnum dpick(dmask m, dnum a, dnum b) { return m ? a : b; }
LANE_FN dnum dsquare_root(dnum x) { return __builtin_sqrt(x); }
LANE_FN unsigned dmask_bits(dmask m) { return m != 0; }
#else
LANE_FN dnum dabsolute(dnum x) { return (dnum)((dmask)x & INT64_MAX); } // clears the sign bit
LANE_FN void dnum_store_float(float *at, dnum x)
{
    typedef float part __attribute__((vector_size(DLANES * 4)));
    part f = __builtin_convertvector(x, part);
    memcpy(at, &f, sizeof f);
}
LANE_FN dnum dnum_of(double x) { return x - (dnum){0}; }
LANE_FN dnum dnum_load(const double *at) { return (dnum) * (const dnum_memory *)at; }
LANE_FN dnum dnum_load_float(const float *at)
{
    typedef float part __attribute__((vector_size(DLANES * 4)));
    part f;
    memcpy(&f, at, sizeof f);
    return __builtin_convertvector(f, dnum);
}
LANE_FN void dnum_store(double *at, dnum x) { *(dnum_memory *)at = (dnum_memory)x; }
LANE_FN dnum dpick(dmask m, dnum a, dnum b) { return (dnum)(((dmask)a & m) | ((dmask)b & ~m)); }
// Returns √x, correctly rounded.
LANE_FN dnum dsquare_root(dnum x)
{
#if LANES == 16 && defined(__AVX512F__)
    return (dnum)_mm512_sqrt_pd((__m512d)x);
#elif LANES == 8 && defined(__AVX__)
    return (dnum)_mm256_sqrt_pd((__m256d)x);
#elif LANES == 4 && defined(__SSE2__)
    return (dnum)_mm_sqrt_pd((__m128d)x);
#elif LANES == 4 && defined(__wasm_simd128__)
    return (dnum)wasm_f64x2_sqrt((v128_t)x);
#else
    dnum r = x;
    for (int i = 0; i < DLANES; i++)
        r[i] = __builtin_sqrt(x[i]);
    return r;
#endif
}
LANE_FN unsigned dmask_bits(dmask m) // bit i is lane i
{
#if LANES == 16 && defined(__AVX512DQ__)
    return (unsigned)_mm512_movepi64_mask((__m512i)m);
#elif LANES == 8 && defined(__AVX__)
    return (unsigned)_mm256_movemask_pd((__m256d)m);
#elif LANES == 4 && defined(__SSE2__)
    return (unsigned)_mm_movemask_pd((__m128d)m);
#elif LANES == 4 && defined(__wasm_simd128__)
    return wasm_i64x2_bitmask((v128_t)m);
#else
    unsigned bits = 0;
    for (int i = 0; i < DLANES; i++)
        bits |= (unsigned)(m[i] & 1) << i;
    return bits;
#endif
}
#endif

// The minimum and maximum, defined like min_of and max_of in lanes.h.
#if LANES == 4 && defined(__SSE2__)
LANE_FN dnum dmin_of(dnum a, dnum b) { return (dnum)_mm_min_pd((__m128d)a, (__m128d)b); }
LANE_FN dnum dmax_of(dnum a, dnum b) { return (dnum)_mm_max_pd((__m128d)a, (__m128d)b); }
#elif LANES == 4
LANE_FN dnum dmin_of(dnum a, dnum b) { return dpick(a < b, a, b); }
LANE_FN dnum dmax_of(dnum a, dnum b) { return dpick(a > b, a, b); }
#endif

#endif
