// gltf_objects.h: converts nodes with meshes to objects of the scene.
#ifndef GLTF_OBJECTS_H
#define GLTF_OBJECTS_H

#include "gltf.h"

// Adds objects for the scene's nodes with meshes: one for each primitive of each node, or of each instance of the node
// (EXT_mesh_gpu_instancing).
bool gltf_objects_add(struct gltf *gltf);

#endif
