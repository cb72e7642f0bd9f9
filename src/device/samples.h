// samples.h: the sample positions in a pixel.
#ifndef SAMPLES_H
#define SAMPLES_H

#include <stdint.h>

enum { SAMPLES_MAX = 16 };

// Sample positions in 1/16 pixel from the pixel's centre (y down), and their order by distance from the centre.
struct sample_pattern {
    int count;
    int8_t x[SAMPLES_MAX], y[SAMPLES_MAX];
    int8_t min, max; // the smallest and the largest of all x and y
    uint8_t by_distance[SAMPLES_MAX];
};
const struct sample_pattern *sample_pattern(int samples);

#endif
