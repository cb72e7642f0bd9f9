// gltf_deform.h: applies morph targets (section 3.7.2.2) and skins (section 3.7.3.3) to a primitive.
#ifndef GLTF_DEFORM_H
#define GLTF_DEFORM_H

#include "gltf.h"
#include "gltf_skins.h"

// The changes that a node makes to its mesh.
struct gltf_deformation {
    const double *weights; // weights of the morph targets
    size_t weight_count;
    const struct gltf_skin *skin; // may be NULL
};

// Replaces the mesh's positions, normals, tangents and texture coordinates with changed copies, if a skin or morph
// targets with nonzero weights change them. Sets *skinned to true if the positions are now in the file's space,
// otherwise to false.
bool gltf_deform(struct gltf *gltf, const struct place *place, const json_t *primitive,
                 const struct gltf_deformation *deformation, lam_mesh *mesh, bool *skinned);

#endif
