// position_simd.c: implements positions.h, compiled once for each instruction set (meson.build, with ISA and
// LANES).
#include "positions.h"

#include "lanes.h"

static inline uint32_t bits_of_number(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits == 0x80000000u ? 0 : bits;
}

// The compiler vectorizes the first loop, because its length is constant.
static uint64_t test(const float *points, uint32_t count, const struct position_filter *filter, uint32_t hashes[WORD])
{
    float padded[3 * WORD];
    if (count < WORD) {
        memset(padded, 0, sizeof padded);
        memcpy(padded, points, count * 3 * sizeof *points);
        points = padded;
    }
    for (uint32_t i = 0; i < WORD; i++) {
        uint32_t bits[3] = {bits_of_number(points[3 * i]), bits_of_number(points[3 * i + 1]),
                            bits_of_number(points[3 * i + 2])};
        hashes[i] = hash_position(bits);
    }
    uint64_t has = 0;
    for (uint32_t i = 0; i < WORD; i += LANES) {
        inum hash = inum_load((const int32_t *)hashes + i);
#if LANES == 1
        inum slot = (int32_t)((uint32_t)hash >> filter->shift);
#else
        inum slot = (inum)((unsigned_lanes)hash >> filter->shift);
#endif
        inum word = igather((const int32_t *)filter->words, slot);
        inum bit = word >> (hash & 31) & word >> (hash >> 5 & 31);
        has |= (uint64_t)mask_bits((bit & 1) == 1) << i;
    }
    return count < WORD ? has & (((uint64_t)1 << count) - 1) : has;
}

static void number(uint64_t members, uint32_t first, uint32_t numbers[WORD])
{
    for (uint32_t i = 0; i < WORD; i += LANES) {
        unsigned bits = (unsigned)(members >> i) & (unsigned)(((uint64_t)1 << LANES) - 1);
        inum x = wrap_add(bits_up_to_lane(bits), inum_of((int32_t)(first - 1)));
        inum_store((int32_t *)numbers + i, ipick(mask_of_bits(bits), x, inum_of(-1)));
        first += (uint32_t)__builtin_popcount(bits);
    }
}

static uint32_t list(const uint32_t *indices, const uint32_t *position_of, uint32_t first, uint32_t count,
                     uint32_t *corners, uint32_t *positions)
{
    uint32_t listed = 0, i = 0;
    for (; i + LANES <= count; i += LANES) {
        inum position = igather((const int32_t *)position_of, inum_load((const int32_t *)indices + i));
        unsigned bits = mask_bits(position != -1);
        pack_lanes((int32_t *)positions + listed, bits, position);
        listed +=
            pack_lanes((int32_t *)corners + listed, bits, wrap_add(inum_of((int32_t)(first + i)), lane_numbers()));
    }
    for (; i < count; i++) {
        corners[listed] = first + i;
        positions[listed] = position_of[indices[i]];
        listed += positions[listed] != UINT32_MAX;
    }
    return listed;
}

extern const struct position_simd FOR_ISA(position_simd);
const struct position_simd FOR_ISA(position_simd) = {.lanes = LANES, .test = test, .number = number, .list = list};
