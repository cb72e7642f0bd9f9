// opacity.h: what a triangle keeps of the light that crosses it.
#ifndef OPACITY_H
#define OPACITY_H

#include "frame.h"

// The opacity of a triangle of the frame, 0…1, where its corners have the weights 1 − b1 − b2, b1 and b2, textures taken at their
// level 0. A masked surface has 0 or 1. `back`: of its back side.
float ray_opacity(const struct frame *frame, uint32_t number, bool back, float b1, float b2);

#endif
