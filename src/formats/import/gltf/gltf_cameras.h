// gltf_cameras.h: reads the file's cameras (section 3.10).
#ifndef GLTF_CAMERAS_H
#define GLTF_CAMERAS_H

#include "gltf.h"

// Adds the cameras of the scene's nodes.
bool gltf_cameras_add(struct gltf *gltf);

#endif
