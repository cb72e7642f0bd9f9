// gltf_draco.h: primitives compressed with Draco (KHR_draco_mesh_compression).
#ifndef GLTF_DRACO_H
#define GLTF_DRACO_H

#include "gltf.h"

// Decodes a compressed primitive's attributes and indices into its accessors, and sets *mode to the mode of the decoded
// triangles. If the decoder is not installed, the accessors' uncompressed bytes are used; a file without such bytes is
// an error.
bool gltf_draco_decode(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t *mode);

#endif
