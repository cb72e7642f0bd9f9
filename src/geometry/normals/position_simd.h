// position_simd.h: the long loops over vertices and corners of the search for seen positions, compiled once for
// each width of registers.
#ifndef POSITION_SIMD_H
#define POSITION_SIMD_H

#include <stdint.h>

enum { WORD = 64 }; // vertices or corners worked on together: a word of a set

// Bits that tell most positions that are in a set from those that are not: two of the word that the hash's
// upper bits choose.
struct seen_filter {
    uint32_t *words;
    unsigned shift; // < 32
};

static inline uint32_t seen_filter_bits(uint32_t hash)
{
    return (uint32_t)1 << (hash & 31) | (uint32_t)1 << (hash >> 5 & 31);
}

// A hash of a position's bits (weld.h). Round numbers have none but upper bits, so these come down first.
static inline uint32_t seen_hash(const uint32_t bits[3])
{
    uint32_t h = (bits[0] ^ bits[0] >> 16) * 0x9e3779b1u;
    h = (h ^ h >> 15 ^ bits[1] ^ bits[1] >> 16) * 0x85ebca77u;
    h = (h ^ h >> 15 ^ bits[2] ^ bits[2] >> 16) * 0xc2b2ae3du;
    return h ^ h >> 16;
}

struct seen_lanes {
    int lanes; // 32-bit numbers in a register
    // The hashes of WORD or fewer points, 3 floats each. Bit i: the filter has point i.
    uint64_t (*ask)(const float *points, uint32_t count, const struct seen_filter *filter, uint32_t hashes[WORD]);
    // Numbers the members of a word of a set from `first` on; the others get UINT32_MAX.
    void (*number)(uint64_t members, uint32_t first, uint32_t numbers[WORD]);
    // Lists those of `count` corners from number `first` on whose vertices, at `indices`, have a position.
    // The lists have room for a register more.
    uint32_t (*list)(const uint32_t *indices, const uint32_t *position_of, uint32_t first, uint32_t count,
                     uint32_t *corners, uint32_t *positions);
};

// The widest that the processor has, and not wider than `lanes`.
const struct seen_lanes *seen_lanes_of(int lanes);

#endif
