// light_bounds.h: the lights of a frame in rows, so that many lights at a time can be tested against the bounds of a
// section of the picture (light_cull.inc).
#ifndef LIGHT_BOUNDS_H
#define LIGHT_BOUNDS_H

#include "buffer.h"
#include "frame.h"

struct material_products;

enum {
    LIGHTS_IN_GROUP = 16,   // neighbouring lights that are tested together
    LIGHTS_ALL_SUMMED = 16, // in frames with at most this many lights, only lights that add nothing are dropped
};

// Lights with a range come first, in Morton order (1966). Lights without a range follow. The rows are padded to a
// multiple of LIGHTS_IN_GROUP with lights that reach no point.
struct light_bounds {
    int count, capacity;      // number of lights, without and with the padding of the last group
    const uint32_t *number;   // index in the frame
    const float *position[3]; // position in eye space, or the direction to a directional light
    const int32_t *far;       // −1 for a directional light, otherwise 0
    const float *axis[3];     // the axis of a spot light; otherwise 0
    const float *min_cosine;  // the cosine of the angle at which the cone of a spot light ends; −2 if there is no cone
    const float *attenuation[3];
    const float *inverse_range; // 0 if the light has no range
    // `capacity` numbers per material. For the diffuse term, the largest channel of kd ⊙ Ld, before vertex colours tint
    // it (with gl1, the largest channel of ka ⊙ La is added). For the specular term, the largest channel of ks ⊙ Ls.
    const float *max_diffuse, *max_specular;
    // For each group: the bounding box of the lights, and the maximum of their ranges. The maximum is infinite if a
    // light has no range.
    int group_count, group_capacity;
    const float *group_low[3], *group_high[3], *group_reach;
    const uint32_t *all; // 0, 1, 2 … count − 1
    // The sum of the lights that are dropped at a point is below this value, in linear light.
    float cutoff;
};

// Fills the table; `storage` owns the table's rows. Returns false if memory runs out.
bool light_bounds_make(struct light_bounds *table, struct buffer *storage, const struct frame *frame,
                       const struct material_products *materials, struct call_control *call, lam_error *error);

// Returns whether the frame has so many lights that culling saves time.
static inline bool light_culling_wanted(const struct frame *frame)
{
    return frame->light_count > (frame->settings.shading == LAM_SHADING_PHONG ? 4 : LIGHTS_ALL_SUMMED);
}

#endif
