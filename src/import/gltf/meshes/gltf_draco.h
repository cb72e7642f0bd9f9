// gltf_draco.h: primitives compressed by Draco (KHR_draco_mesh_compression).
#ifndef GLTF_DRACO_H
#define GLTF_DRACO_H

#include "gltf.h"

// Decodes a primitive's attributes and indices into the accessors that it names, where it is compressed, and sets *mode to that of
// the decoded triangles. Where the decoder is not installed, the accessors' own bytes serve, and a file without them is an error.
bool gltf_draco_decode(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t *mode);

#endif
