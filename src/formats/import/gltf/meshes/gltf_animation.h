// gltf_animation.h: evaluates an animation at one time (section 3.11).
#ifndef GLTF_ANIMATION_H
#define GLTF_ANIMATION_H

#include "gltf.h"

// Sets the transforms and weights of nodes for the requested time. If no animation is requested, the transforms and
// weights remain as in the file.
bool gltf_animation_apply(struct gltf *gltf);

#endif
