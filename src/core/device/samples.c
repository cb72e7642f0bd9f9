// samples.c: the sample positions in a pixel. These are the standard multisample patterns of Direct3D (D3D11 functional
// specification, "Multisample patterns"), which graphics processors also use.
#include "samples.h"

// by_distance lists the sample indices by their distance from the centre, the nearest first. Samples at equal distances
// are in ascending order.
static const struct sample_pattern patterns[] = {
    {.count = 1, .x = {0}, .y = {0}, .min = 0, .max = 0, .by_distance = {0}},
    {.count = 2, .x = {4, -4}, .y = {4, -4}, .min = -4, .max = 4, .by_distance = {0, 1}},
    {.count = 4, .x = {-2, 6, -6, 2}, .y = {-6, -2, 2, 6}, .min = -6, .max = 6, .by_distance = {0, 1, 2, 3}},
    {.count = 8,
     .x = {1, -1, 5, -3, -5, -7, 3, 7},
     .y = {-3, 3, 1, -5, 5, -1, 7, -7},
     .min = -7,
     .max = 7,
     .by_distance = {0, 1, 2, 3, 4, 5, 6, 7}},
    {.count = 16,
     .x = {1, -1, -3, 4, -5, 2, 5, 3, -2, 0, -4, -6, -8, 7, 6, -7},
     .y = {1, -3, 2, -1, -2, 5, 3, -5, 6, -7, -6, 4, 0, -4, 7, -8},
     .min = -8,
     .max = 7,
     .by_distance = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}},
};

const struct sample_pattern *sample_pattern(int samples)
{
    for (unsigned i = 0; i < sizeof patterns / sizeof patterns[0]; i++)
        if (patterns[i].count == samples)
            return &patterns[i];
    return &patterns[2];
}
