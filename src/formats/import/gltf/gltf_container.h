// gltf_container.h: reads .glb files: a header, and chunks that contain the JSON text and the binary buffer (section
// 4).
#ifndef GLTF_CONTAINER_H
#define GLTF_CONTAINER_H

#include "gltf.h"

static inline bool gltf_is_binary(const uint8_t *bytes, size_t size)
{
    return size >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

// Finds the JSON text: a chunk of a .glb file, or the whole of any other file. Sets gltf->binary.
bool gltf_container_read(struct gltf *gltf, const uint8_t **text, size_t *size);

#endif
