// triples.h: loads and stores points that are stored as x y z x y z ….
//
// Points are loaded and stored four floats at a time and transposed in registers, which is several times faster than
// loading and storing each float separately.
#ifndef TRIPLES_H
#define TRIPLES_H

#include "lanes.h"

// Loads three floats from each of LANES addresses, or stores them to LANES consecutive points. Four floats are moved at
// a time, so one float after each point must be readable, and `store_triples` overwrites one float after the last
// point.
struct triples {
    num x, y, z;
};
#if LANES == 1
LANE_FN struct triples load_triples(const float *const at[LANES])
{
    return (struct triples){at[0][0], at[0][1], at[0][2]};
}
LANE_FN void store_triples(float *to, struct triples t)
{
    to[0] = t.x;
    to[1] = t.y;
    to[2] = t.z;
}
#else
typedef float quad __attribute__((vector_size(16)));
typedef float quad_memory __attribute__((vector_size(16), aligned(4), may_alias));
// Loads the quads i, i + 4, i + 8 … into one vector.
LANE_FN num split_quads(const float *const at[LANES], int i)
{
#define QUAD(n) ((quad) * (const quad_memory *)at[n])
#if LANES == 4
    return QUAD(i);
#else
    typedef float pair __attribute__((vector_size(32)));
    pair low = __builtin_shufflevector(QUAD(i), QUAD(i + 4), 0, 1, 2, 3, 4, 5, 6, 7);
#if LANES == 8
    return low;
#else
    pair high = __builtin_shufflevector(QUAD(i + 8), QUAD(i + 12), 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#endif
#endif
#undef QUAD
}
// In each quad, selects two of the floats of a (0 … 3) and two of the floats of b (4 … 7).
#define FROM(i, quad)             ((i) % 4 + 4 * (quad) + ((i) < 4 ? 0 : LANES))
#define OF_QUAD(i, j, k, l, quad) FROM(i, quad), FROM(j, quad), FROM(k, quad), FROM(l, quad)
#if LANES == 4
#define SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, OF_QUAD(i, j, k, l, 0))
#elif LANES == 8
#define SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, OF_QUAD(i, j, k, l, 0), OF_QUAD(i, j, k, l, 1))
#else
#define SHUFFLE(a, b, i, j, k, l)                                                                                      \
    __builtin_shufflevector(a, b, OF_QUAD(i, j, k, l, 0), OF_QUAD(i, j, k, l, 1), OF_QUAD(i, j, k, l, 2),              \
                            OF_QUAD(i, j, k, l, 3))
#endif
LANE_FN struct triples load_triples(const float *const at[LANES])
{
    num a = split_quads(at, 0), b = split_quads(at, 1), c = split_quads(at, 2), d = split_quads(at, 3);
    num xy_low = SHUFFLE(a, b, 0, 4, 1, 5), xy_high = SHUFFLE(c, d, 0, 4, 1, 5);
    num z_low = SHUFFLE(a, b, 2, 6, 3, 7), z_high = SHUFFLE(c, d, 2, 6, 3, 7);
    return (struct triples){SHUFFLE(xy_low, xy_high, 0, 1, 4, 5), SHUFFLE(xy_low, xy_high, 2, 3, 6, 7),
                            SHUFFLE(z_low, z_high, 0, 1, 4, 5)};
}
LANE_FN void store_triples(float *to, struct triples t)
{
    num xy_low = SHUFFLE(t.x, t.y, 0, 4, 1, 5), xy_high = SHUFFLE(t.x, t.y, 2, 6, 3, 7);
    num zz_low = SHUFFLE(t.z, t.z, 0, 0, 1, 1), zz_high = SHUFFLE(t.z, t.z, 2, 2, 3, 3);
    num of[4] = {SHUFFLE(xy_low, zz_low, 0, 1, 4, 5), SHUFFLE(xy_low, zz_low, 2, 3, 6, 7),
                 SHUFFLE(xy_high, zz_high, 0, 1, 4, 5), SHUFFLE(xy_high, zz_high, 2, 3, 6, 7)};
    for (int i = 0; i < LANES; i++) { // each store overwrites the fourth float of the previous one
        quad q;
        memcpy(&q, (const char *)&of[i & 3] + 16 * (i >> 2), sizeof q);
        *(quad_memory *)(to + 3 * i) = q;
    }
}
#undef SHUFFLE
#undef OF_QUAD
#undef FROM
#endif

#endif
