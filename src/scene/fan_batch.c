// fan_batch.c: positions that wait until enough of them have equally many corners.
#include "fan_batch.h"

#include "cpu_features.h"

#include <string.h>

extern const struct fan_lanes fan_lanes_plain;
#if defined(__x86_64__)
extern const struct fan_lanes fan_lanes_avx2, fan_lanes_avx512;
#endif

const struct fan_lanes *fan_lanes_of(int lanes)
{
#if defined(__x86_64__)
    unsigned have = cpu_features();
    if (lanes >= 16 && have & CPU_AVX512)
        return &fan_lanes_avx512;
    if (lanes >= 8 && have & CPU_AVX2)
        return &fan_lanes_avx2;
#endif
    (void)lanes;
    return &fan_lanes_plain;
}

uint32_t fan_batch_take(struct fan_batch *batch, uint32_t count)
{
    uint32_t places = batch->waiting[count];
    if (!places)
        return 0;
    batch->waiting[count] = 0;
    batch->block.count = count;
    memcpy(batch->block.corners, batch->rows + count * (count - 1) / 2, count * sizeof *batch->rows);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t p = places; p < FAN_PLACES; p++)
            batch->block.corners[i][p] = batch->block.corners[i][places - 1];
    return places;
}
