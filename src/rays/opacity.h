// opacity.h: what a triangle keeps of the light that crosses it, and what it lets through.
#ifndef OPACITY_H
#define OPACITY_H

#include "frame.h"

// The opacity of a triangle of the frame, 0…1, where its corners have the weights 1 − b1 − b2, b1 and b2, textures taken at their
// level 0. A masked surface has 0 or 1. `back`: of its back side.
float ray_opacity(const struct frame *frame, uint32_t number, bool back, float b1, float b2);

// The light that such a point lets through, red, green, blue: 1 − opacity, and of the opaque share what goes on behind a
// surface that transmits: transmission (1 − metallic) · base. The boundary of a volume counts where light enters it.
void ray_transmittance(const struct frame *frame, uint32_t number, bool back, float b1, float b2, float out[3]);

#endif
