// gltf_deform.h: morph targets (section 3.7.2.2) and skins (section 3.7.3.3) applied to a primitive.
#ifndef GLTF_DEFORM_H
#define GLTF_DEFORM_H

#include "gltf.h"
#include "gltf_skins.h"

// How a node changes the mesh that it shows.
struct gltf_deformation {
    const double *weights; // of the morph targets
    size_t weight_count;
    const struct gltf_skin *skin; // NULL: none
};

// Replaces the mesh's positions, normals, tangents and texture coordinates by arrays of its own where targets with a weight other than 0, or a skin, change them. *skinned: its positions are now in the file's space.
bool gltf_deform(struct gltf *gltf, const struct place *place, const json_t *primitive,
                 const struct gltf_deformation *deformation, lam_mesh *mesh, bool *skinned);

#endif
