// light_bounds.h: the lights of a frame as rows of numbers, so that many at a time can be left out of a part
// of the picture that they do not reach (light_cull.inc).
#ifndef LIGHT_BOUNDS_H
#define LIGHT_BOUNDS_H

#include "buffer.h"
#include "frame.h"

struct material_products;

enum {
    LIGHTS_IN_GROUP = 16,   // lights near each other, passed over at once
    LIGHTS_ALL_SUMMED = 16, // frames with up to this many leave out only what adds exactly nothing
};

// Lights by place: those with a range first, in Morton's order (1966), then the others. Rows are filled up to
// a multiple of LIGHTS_IN_GROUP with lights that reach nothing.
struct light_bounds {
    int count, room;           // lights; with what fills the last group
    const uint32_t *number;    // in the frame
    const float *position[3];  // eye space; for a directional light the way to it
    const int32_t *far;        // −1: directional; else 0
    const float *axis[3];      // of a spot; else 0
    const float *least_cosine; // between axis and way out, below which nothing arrives; −2: no cone
    const float *attenuation[3];
    const float *inverse_range; // 0: none
    // For each material, room numbers: the largest channel of kd ⊙ Ld, and of ks ⊙ Ls and what else does not
    // take part in a vertex colour.
    const float *most_diffuse, *most_specular;
    // Of each group: the box of its lights and how far they reach; infinite where one has no end.
    int group_count, group_room;
    const float *group_low[3], *group_high[3], *group_reach;
    const uint32_t *all; // 0, 1, 2 … count − 1: a list of all of them
    // Together, the lights left out at a point stay below this, in linear light.
    float cutoff;
};

// Fills the table; the storage keeps its rows. False: out of memory.
bool light_bounds_make(struct light_bounds *table, struct buffer *storage, const struct frame *frame,
                       const struct material_products *materials, struct call_control *call, lam_error *error);

// Lists of lights are made for frames with more lights than this.
static inline bool light_lists_wanted(const struct frame *frame)
{
    return frame->light_count > (frame->shading == LAM_SHADING_PHONG ? 4 : LIGHTS_ALL_SUMMED);
}

#endif
