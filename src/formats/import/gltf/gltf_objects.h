// gltf_objects.h: converts nodes with meshes to objects of the scene.
#ifndef GLTF_OBJECTS_H
#define GLTF_OBJECTS_H

#include "gltf.h"

// Adds objects for the scene's nodes with meshes: one object for each primitive of the node's mesh. If the node has
// instances (EXT_mesh_gpu_instancing), adds these objects for each instance.
bool gltf_objects_add(struct gltf *gltf);

#endif
