// position_simd.h: finds shared positions with long loops over vertices and corners, and computes the bits and the hash
// of a position. The loops are compiled once for each instruction set (meson.build).
#ifndef POSITION_SIMD_H
#define POSITION_SIMD_H

#include <stdint.h>

enum { WORD = 64 }; // vertices or corners that are processed together: one for each bit in a word of a bit set

// A Bloom filter with two bits per position, both in the word selected by the hash's upper bits.
struct position_filter {
    uint32_t *words;
    unsigned shift; // < 32
};

static inline uint32_t position_filter_bits(uint32_t hash)
{
    return (uint32_t)1 << (hash & 31) | (uint32_t)1 << (hash >> 5 & 31);
}

// Gets the bits of a position. −0 is replaced with 0, so that equal positions have equal bits.
static inline void position_bits(const float *position, uint32_t bits[3])
{
    for (int a = 0; a < 3; a++) {
        uint32_t of;
        __builtin_memcpy(&of, position + a, 4);
        bits[a] = of == 0x80000000u ? 0 : of;
    }
}

static inline int same_position(const uint32_t a[3], const uint32_t b[3])
{
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

// Returns a hash of a position's bits. Round numbers have only upper bits set, so the upper bits are first combined
// with the lower bits.
static inline uint32_t hash_position(const uint32_t bits[3])
{
    uint32_t h = (bits[0] ^ bits[0] >> 16) * 0x9e3779b1u;
    h = (h ^ h >> 15 ^ bits[1] ^ bits[1] >> 16) * 0x85ebca77u;
    h = (h ^ h >> 15 ^ bits[2] ^ bits[2] >> 16) * 0xc2b2ae3du;
    return h ^ h >> 16;
}

struct position_simd {
    int lanes; // 32-bit numbers per register
    // Hashes at most WORD points of 3 floats. Bit i of the result is set if the filter may contain point i.
    uint64_t (*test)(const float *points, uint32_t count, const struct position_filter *filter, uint32_t hashes[WORD]);
    // Numbers the members in one word of a set, starting with `first`. All other items get UINT32_MAX.
    void (*number)(uint64_t members, uint32_t first, uint32_t numbers[WORD]);
    // Examines `count` corners, from number `first` on, and lists those whose vertices (`indices`) are at a listed
    // position. Each list needs capacity for `count` entries plus one register.
    uint32_t (*list)(const uint32_t *indices, const uint32_t *position_of, uint32_t first, uint32_t count,
                     uint32_t *corners, uint32_t *positions);
};

// Returns the widest version that the processor supports, with at most `lanes` lanes.
const struct position_simd *position_simd_for(int lanes);

#endif
