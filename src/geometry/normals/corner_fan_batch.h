// corner_fan_batch.h: positions that wait until enough of them have equally many corners to be worked out side by
// side (corner_fan_simd.h). Those where more corners meet than FAN_FEW, or a triangle without area, are left to
// corner_fan.h, one by one. The bits are the same either way.
#ifndef CORNER_FAN_BATCH_H
#define CORNER_FAN_BATCH_H

#include "corner_fan_simd.h"

enum { FAN_ROWS = FAN_FEW * (FAN_FEW + 1) / 2 };

struct fan_batch {
    uint32_t waiting[FAN_FEW + 1]; // positions, of each count of corners
    fan_numbers rows[FAN_ROWS];    // their corners: one row for count 1, two for count 2 …
    struct fan_block block;
};

static inline void fan_batch_start(struct fan_batch *batch)
{
    for (uint32_t count = 0; count <= FAN_FEW; count++)
        batch->waiting[count] = 0;
}

// Adds a position with its corners, in any order; 0 < count ≤ FAN_FEW. True: as many wait as can; take them.
static inline bool fan_batch_add(struct fan_batch *batch, const uint32_t *corners, uint32_t count)
{
    fan_numbers *rows = batch->rows + count * (count - 1) / 2;
    uint32_t place = batch->waiting[count]++;
    for (uint32_t i = 0; i < count; i++)
        rows[i][place] = corners[i];
    return place + 1 == FAN_PLACES;
}

// Those with that many corners into batch->block, ready to be made. False: there are none.
bool fan_batch_take(struct fan_batch *batch, uint32_t count);

#endif
