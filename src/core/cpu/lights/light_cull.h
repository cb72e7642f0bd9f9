// light_cull.h: the list of lights that can reach a group of points (light_cull.inc).
#ifndef LIGHT_CULL_H
#define LIGHT_CULL_H

#include <stdint.h>

struct light_list {
    uint32_t *numbers; // indices in the frame, ascending
    int count;
    uint64_t *bits; // one bit for each light of the frame: whether the light is listed
    float *bound;   // scratch memory: the maximum contribution of each light
};

#endif
