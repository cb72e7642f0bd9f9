// corner_fan_batch.c: positions that wait until enough of them have equally many corners.
#include "corner_fan_batch.h"

#include "cpu_features.h"

#include <string.h>

extern const struct fan_lanes fan_lanes_scalar, fan_lanes_avx2, fan_lanes_avx512;

const struct fan_lanes *fan_lanes_of(int lanes)
{
    return CPU_WIDEST(lanes, &fan_lanes_scalar, &fan_lanes_avx2, &fan_lanes_avx512);
}

bool fan_batch_take(struct fan_batch *batch, uint32_t count)
{
    struct fan_block *block = &batch->block;
    block->count = count;
    block->places = batch->waiting[count];
    batch->waiting[count] = 0;
    memcpy(block->corners, batch->rows + count * (count - 1) / 2, count * sizeof *batch->rows);
    for (uint32_t i = 0; block->places && i < count; i++)
        for (uint32_t p = block->places; p < FAN_PLACES; p++)
            block->corners[i][p] = block->corners[i][p - 1];
    return block->places > 0;
}
