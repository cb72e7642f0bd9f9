// gltf_meshopt.h: compressed bufferViews (EXT_meshopt_compression).
#ifndef GLTF_MESHOPT_H
#define GLTF_MESHOPT_H

#include "gltf.h"

// Decodes a compressed bufferView into memory of the scene. Sets *done to whether the bufferView was decoded. If
// meshoptimizer is not installed, *done is false and the caller must use the bufferView's uncompressed bytes; a
// bufferView without such bytes is an error. Returns false on error.
bool gltf_meshopt_decode(struct gltf *gltf, const struct place *place, const json_t *view, struct gltf_view *out,
                         bool *done);

#endif
