// gltf_animation.h: one moment of an animation (section 3.11).
#ifndef GLTF_ANIMATION_H
#define GLTF_ANIMATION_H

#include "gltf.h"

// Sets the transforms and weights of nodes to those at the time that the caller wants. Without an animation they stay as
// the file has them.
bool gltf_animation_apply(struct gltf *gltf);

#endif
