// samples.h: the sample positions in a pixel.
#ifndef SAMPLES_H
#define SAMPLES_H

#include <stdint.h>

enum { SAMPLES_MAX = 16 };

// The sample positions relative to the pixel's centre, in units of 1/16 pixel (y down), and the order of the samples by
// distance from the centre.
struct sample_pattern {
    int count;
    int8_t x[SAMPLES_MAX], y[SAMPLES_MAX];
    int8_t min, max; // the smallest and the largest of all x and y
    uint8_t by_distance[SAMPLES_MAX];
};
const struct sample_pattern *sample_pattern(int samples);

#endif
