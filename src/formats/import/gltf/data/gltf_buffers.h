// gltf_buffers.h: buffers and bufferViews (section 3.6.1).
#ifndef GLTF_BUFFERS_H
#define GLTF_BUFFERS_H

#include "gltf.h"

bool gltf_buffers_start(struct gltf *gltf);

// Returns the bufferView with this index, which gltf_take_index has checked. Reads its buffer. Returns NULL on error.
const struct gltf_view *gltf_view_at(struct gltf *gltf, int index);

// Gets a range of bytes of a buffer, and reads the buffer on first use. Returns false if the range is outside the
// buffer.
bool gltf_buffer_bytes(struct gltf *gltf, const struct place *place, int index, size_t offset, size_t length,
                       const uint8_t **out);

// Marks a buffer as kept: its bytes remain in memory as long as the scene exists, because an array of the scene points
// into them.
void gltf_buffer_keep(struct gltf *gltf, int buffer);

// Moves kept buffers to the scene and releases the others. Returns false if memory runs out.
bool gltf_buffers_end(struct gltf *gltf);

#endif
