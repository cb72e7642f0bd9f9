// corner_fan_batch.h: collects positions by their number of corners. As soon as enough positions have the same number,
// the normals at these positions are computed in parallel lanes (corner_fan_simd.h). Positions with more than
// FAN_CORNERS_MAX corners, or with a degenerate triangle, are processed one by one by corner_fan.h. The two methods
// produce identical bits.
#ifndef CORNER_FAN_BATCH_H
#define CORNER_FAN_BATCH_H

#include "corner_fan_simd.h"

enum { FAN_ROWS = FAN_CORNERS_MAX * (FAN_CORNERS_MAX + 1) / 2 };

struct corner_fan_batch {
    uint32_t waiting[FAN_CORNERS_MAX + 1]; // number of positions for each number of corners
    fan_row rows[FAN_ROWS];                // the corners of the fans: a position with n corners needs n rows
    struct corner_fan_block block;
};

static inline void corner_fan_batch_start(struct corner_fan_batch *batch)
{
    for (uint32_t count = 0; count <= FAN_CORNERS_MAX; count++)
        batch->waiting[count] = 0;
}

// Adds a position with its corners, in any order; 0 < count ≤ FAN_CORNERS_MAX. Returns true if the row is full; the
// caller must then call corner_fan_batch_take.
static inline bool corner_fan_batch_add(struct corner_fan_batch *batch, const uint32_t *corners, uint32_t count)
{
    fan_row *rows = batch->rows + count * (count - 1) / 2;
    uint32_t p = batch->waiting[count]++;
    for (uint32_t i = 0; i < count; i++)
        rows[i][p] = corners[i];
    return p + 1 == FAN_POSITIONS;
}

// Moves the positions with `count` corners into batch->block. Returns false if there are none.
bool corner_fan_batch_take(struct corner_fan_batch *batch, uint32_t count);

#endif
