// gltf_lights.h: reads the file's lights (KHR_lights_punctual).
#ifndef GLTF_LIGHTS_H
#define GLTF_LIGHTS_H

#include "gltf.h"

// Adds the lights of the scene's nodes.
bool gltf_lights_add(struct gltf *gltf);

#endif
