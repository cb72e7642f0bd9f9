// light_cull.h: the list of lights that can reach a group of points (light_cull.inc).
#ifndef LIGHT_CULL_H
#define LIGHT_CULL_H

#include <stdint.h>

struct light_list {
    uint32_t *numbers; // indices in the frame, ascending
    int count;
    uint64_t *bits; // one for each light of the frame: whether it is listed
    float *bound;   // scratch memory: the most that each light can add
};

#endif
