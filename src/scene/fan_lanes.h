// fan_lanes.h: the arithmetic of fans (normals_fan.h) for many corners side by side, compiled once for each
// width of registers. Every width gives the bits of normals_fan.c.
#ifndef FAN_LANES_H
#define FAN_LANES_H

#include <stddef.h>
#include <stdint.h>

enum {
    FAN_CORNERS = 256, // looked at together: what they take stays in the first-level cache
    FAN_STEP = 16,     // counts are rounded up to this, and what lies behind them is computed too
};
_Static_assert(FAN_CORNERS % FAN_STEP == 0, "whole steps");

struct fan_corners {
    float here[3][FAN_CORNERS], next[3][FAN_CORNERS], before[3][FAN_CORNERS]; // a triangle's corners
    double normal[3][FAN_CORNERS];                           // of the triangle, unit; zero without area
    double weighted[3][FAN_CORNERS];                         // the normal times the angle at the corner
    uint32_t spans[FAN_CORNERS];                             // 0: the triangle has no area
    uint32_t next_key[FAN_CORNERS], before_key[FAN_CORNERS]; // equal positions have equal keys
};

struct fan_sums {
    double sum[3][FAN_CORNERS];
    float unit[3][FAN_CORNERS];
    uint32_t plain[FAN_CORNERS]; // 0: too large, too small or nothing; `unit` means nothing
};

// Bits that tell most positions that are in a set from those that are not: bit number hash >> shift.
struct fan_filter {
    const uint32_t *bits;
    unsigned shift; // of the hash, 64 − log2 of the bits
};

struct fan_lanes {
    int lanes; // floats in a register
    // Fills what follows from the corners.
    void (*look)(struct fan_corners *corners, size_t count);
    // Makes sums unit.
    void (*unit)(struct fan_sums *sums, size_t count);
    // Of `count` points, 3 floats each: the hashes of their positions (weld.h), and whether the filter has
    // them.
    void (*ask)(const float *points, size_t count, const struct fan_filter *filter, uint64_t *hashes,
                uint32_t *has);
};

// The widest that the processor has, and not wider than `lanes`.
const struct fan_lanes *fan_lanes_of(int lanes);

#endif
