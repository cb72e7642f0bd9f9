// opacity.h: computes the fractions of light that a triangle blocks and transmits.
#ifndef OPACITY_H
#define OPACITY_H

#include "frame.h"

// Returns the opacity (0…1) at a point of a triangle. The weights of the triangle's corners at the point are 1 − b1 −
// b2, b1 and b2. Textures are read at level 0. The opacity of a masked surface is 0 or 1. `back` selects the triangle's
// back side.
float ray_opacity(const struct frame *frame, uint32_t number, bool back, float b1, float b2);

// Gets the light (red, green, blue) that passes through a point of a triangle: 1 − opacity, plus opacity · transmission
// · (1 − metallic) · base. The second term is the light that a transmitting surface lets through. The boundary of a
// volume colours light only where the light enters the volume.
void ray_transmittance(const struct frame *frame, uint32_t number, bool back, float b1, float b2, float out[3]);

// Returns whether a side of a triangle is the inside of a volume that transmits light.
bool ray_leaves_volume(const struct frame *frame, uint32_t number, bool back);

// Returns whether opacity and transmitted light are the same at all points of a triangle.
bool ray_share_is_constant(const struct frame *frame, uint32_t number, bool back);

// The translucent triangles that a group of rays crosses.
struct ray_layers {
    struct ray_layer {
        uint32_t lane, number; // the ray, and the index of the triangle in the frame
        float passed[3];       // share of the light; only the first channel is set if nothing tints the light
    } *list;                   // a growing array, which its owner frees
    int count, capacity;
    bool failed; // out of memory
};

#endif
