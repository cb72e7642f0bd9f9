// double_lanes.h: LANES doubles, beside the floats of lanes.h.
//
//   dnum   LANES doubles          dmask   LANES truths of them; mask_of_dmask makes a mask of num
//
// GCC's and Clang's vector types, two registers where a num is one. As in lanes.h: + − × ÷ and comparisons alone, each
// correctly rounded, so every width gives the same bits.
#ifndef DOUBLE_LANES_H
#define DOUBLE_LANES_H

#include "lanes.h"

#if LANES == 1
typedef double dnum;
typedef int64_t dmask; // 0 or 1
#else
typedef double dnum __attribute__((vector_size(LANES * 8)));
typedef int64_t dmask __attribute__((vector_size(LANES * 8))); // each lane 0 or −1
typedef double dnum_memory __attribute__((vector_size(LANES * 8), aligned(8), may_alias));
#endif

#if LANES == 1
LANE_FN dnum dnum_of(double x) { return x; }
LANE_FN dnum dnum_load(const double *at) { return *at; }
LANE_FN void dnum_store(double *at, dnum x) { *at = x; }
LANE_FN dnum dpick(dmask m, dnum a, dnum b) { return m ? a : b; }
LANE_FN mask mask_of_dmask(dmask m) { return (mask)m; }
LANE_FN num num_of_dnum(dnum x) { return (float)x; }
LANE_FN double dlane(dnum x, int i) { return (void)i, x; }
#else
LANE_FN dnum dnum_of(double x) { return x - (dnum){0}; }
LANE_FN dnum dnum_load(const double *at) { return (dnum) * (const dnum_memory *)at; }
LANE_FN void dnum_store(double *at, dnum x) { *(dnum_memory *)at = (dnum_memory)x; }
LANE_FN dnum dpick(dmask m, dnum a, dnum b) { return (dnum)(((dmask)a & m) | ((dmask)b & ~m)); }
LANE_FN mask mask_of_dmask(dmask m) { return __builtin_convertvector(m, mask); }
LANE_FN num num_of_dnum(dnum x) { return __builtin_convertvector(x, num); }
LANE_FN double dlane(dnum x, int i) { return x[i]; }
#endif
// |x|: clears the sign bit.
LANE_FN dnum dabsolute(dnum x)
{
#if LANES == 1
    return __builtin_fabs(x);
#else
    return (dnum)((dmask)x & INT64_MAX);
#endif
}

#endif
