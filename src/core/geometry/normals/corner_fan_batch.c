// corner_fan_batch.c: moves positions with the same number of corners to a struct corner_fan_block, so that
// corner_fan_simd.c can process them in parallel lanes.
#include "corner_fan_batch.h"

#include "cpu_features.h"

#include <string.h>

extern const struct corner_fan_simd corner_fan_simd_scalar, corner_fan_simd_avx2, corner_fan_simd_avx512;

const struct corner_fan_simd *corner_fan_simd_for(int lanes)
{
    return CPU_WIDEST(lanes, &corner_fan_simd_scalar, &corner_fan_simd_avx2, &corner_fan_simd_avx512);
}

bool corner_fan_batch_take(struct corner_fan_batch *batch, uint32_t count)
{
    struct corner_fan_block *block = &batch->block;
    block->count = count;
    block->positions = batch->waiting[count];
    batch->waiting[count] = 0;
    memcpy(block->corners, batch->rows + count * (count - 1) / 2, count * sizeof *batch->rows);
    for (uint32_t i = 0; block->positions && i < count; i++)
        for (uint32_t p = block->positions; p < FAN_POSITIONS; p++)
            block->corners[i][p] = block->corners[i][p - 1];
    return block->positions > 0;
}
