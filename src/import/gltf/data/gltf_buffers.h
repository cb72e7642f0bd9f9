// gltf_buffers.h: buffers and bufferViews (section 3.6.1).
#ifndef GLTF_BUFFERS_H
#define GLTF_BUFFERS_H

#include "gltf.h"

bool gltf_buffers_start(struct gltf *gltf);

// Returns the bufferView of a number that was checked (gltf_take_index), its buffer read. Returns NULL on error.
const struct gltf_view *gltf_view_at(struct gltf *gltf, int index);

// Bytes of a buffer that is read when first used. Returns false if it has no such bytes.
bool gltf_buffer_bytes(struct gltf *gltf, const struct place *place, int index, size_t offset, size_t length,
                       const uint8_t **out);

// From now on an array of the scene lies in this buffer: its bytes stay as long as the scene.
void gltf_buffer_keep(struct gltf *gltf, int buffer);

// Gives kept buffers to the scene and releases the others. Returns false if memory runs out.
bool gltf_buffers_end(struct gltf *gltf);

#endif
