// gltf_meshopt.h: compressed bufferViews (EXT_meshopt_compression).
#ifndef GLTF_MESHOPT_H
#define GLTF_MESHOPT_H

#include "gltf.h"

// Decodes a compressed bufferView into memory of the scene. Sets *done to true if the bufferView was decoded. If
// meshoptimizer is not installed, sets *done to false, and the caller must use the bufferView's uncompressed bytes. A
// bufferView without such bytes is an error. Returns false on error.
bool gltf_meshopt_decode(struct gltf *gltf, const struct place *place, const json_t *view, struct gltf_view *out,
                         bool *done);

#endif
