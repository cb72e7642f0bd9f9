// gltf_primitives.h: reads the primitives of meshes (section 3.7.2). Each primitive becomes a mesh of the scene.
#ifndef GLTF_PRIMITIVES_H
#define GLTF_PRIMITIVES_H

#include "gltf.h"
#include "gltf_nodes.h"
#include "gltf_skins.h"

// A mesh of the file. Each of its primitives is one mesh of the scene.
struct gltf_primitive {
    int mesh;     // index in the scene; −1 means the primitive is empty
    bool skinned; // the mesh's positions are in the file's space
};
struct gltf_mesh {
    bool ready;
    int count;
    struct gltf_primitive *primitives;
};

bool gltf_meshes_start(struct gltf *gltf);

// Returns a mesh of the file. The mesh is created on first use and shared by all nodes that refer to it. Returns NULL
// on error.
const struct gltf_mesh *gltf_mesh_at(struct gltf *gltf, int index);

// Returns a separate copy of the mesh for one node, deformed by `skin` (may be NULL) and by morph targets. The weights
// of the targets are node->weights or, if node->weights is NULL, the mesh's own weights.
const struct gltf_mesh *gltf_mesh_deformed(struct gltf *gltf, int index, const struct gltf_node *node,
                                           const struct gltf_skin *skin);

#endif
