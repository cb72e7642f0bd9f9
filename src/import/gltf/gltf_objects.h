// gltf_objects.h: converts nodes with meshes to objects of the scene.
#ifndef GLTF_OBJECTS_H
#define GLTF_OBJECTS_H

#include "gltf.h"

// Adds an object for each primitive of each node of the scene that has a mesh, and for each of its instances
// (EXT_mesh_gpu_instancing).
bool gltf_objects_add(struct gltf *gltf);

#endif
