// weld.h: which vertices share a position.
#ifndef WELD_H
#define WELD_H

#include "loop_status.h"
#include "pool.h"

// Numbers the different positions among `count` points (3 floats each) without gaps, in the order of their
// first points, and writes each point's number into position_of. Equal is bit-equal after −0 → 0. count < 2³²
// − 1. `pool` and `call` may be NULL. Takes time in proportion to count, count·log(count) at worst.
bool weld_positions(const float *points, size_t count, uint32_t *position_of, uint32_t *positions, struct pool *pool,
                    struct call_control *call, lam_error *error);

// The bits of a position, with −0 as 0, so that equal positions have equal bits.
static inline void position_bits(const float *position, uint32_t bits[3])
{
    for (int a = 0; a < 3; a++) {
        uint32_t of;
        __builtin_memcpy(&of, position + a, 4);
        bits[a] = of == 0x80000000u ? 0 : of;
    }
}

// A hash of those bits: the upper ones and the lower ones will do by themselves.
static inline uint64_t position_hash(const uint32_t bits[3])
{
    uint64_t h = (bits[0] | (uint64_t)bits[1] << 32) * UINT64_C(0x9e3779b97f4a7c15);
    h = (h ^ h >> 32 ^ bits[2]) * UINT64_C(0xd6e8feb86659fd93);
    return h ^ h >> 32;
}

#endif
