// gltf_primitives.h: the primitives of meshes (section 3.7.2): each becomes a mesh of the scene.
#ifndef GLTF_PRIMITIVES_H
#define GLTF_PRIMITIVES_H

#include "gltf.h"

// A mesh of the file as meshes of the scene, one for each of its primitives.
struct gltf_mesh {
    bool ready;
    int count;
    int *primitives; // indices of the scene's meshes; −1: the primitive has no triangles
};

bool gltf_meshes_start(struct gltf *gltf);

// A mesh of the file, made when first asked for: nodes that name the same mesh share it. NULL: an error.
const struct gltf_mesh *gltf_mesh_at(struct gltf *gltf, int index);

#endif
