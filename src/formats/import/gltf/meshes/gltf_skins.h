// gltf_skins.h: reads skins (section 3.7.3): the matrices of a skin's joints.
#ifndef GLTF_SKINS_H
#define GLTF_SKINS_H

#include "gltf.h"

struct gltf_skin {
    lam_mat4 *joints; // from the mesh's bind space to the file's space
    size_t count;
};

// Returns the skin with this index, which must be valid. Its matrices are computed from the current transforms of the
// nodes. Returns NULL on error.
const struct gltf_skin *gltf_skin_at(struct gltf *gltf, int index);

#endif
