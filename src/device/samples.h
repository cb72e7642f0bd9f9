// samples.h: where the samples of a pixel lie.
#ifndef SAMPLES_H
#define SAMPLES_H

#include <stdint.h>

enum { SAMPLES_MAX = 16 };

// Where samples lie in a pixel, in 1/16 pixel from its centre (y down), and in which order they are near to it.
struct sample_pattern {
    int count;
    int8_t x[SAMPLES_MAX], y[SAMPLES_MAX];
    int8_t least, most; // of x, and of y
    uint8_t by_distance[SAMPLES_MAX];
};
const struct sample_pattern *sample_pattern(int samples);

#endif
