// gl_vertex_key.h: collects all inputs of the colours of a draw's vertices.
#ifndef GL_VERTEX_KEY_H
#define GL_VERTEX_KEY_H

#include "gl_device.h"

// Collects every input of a draw's colours in row->frame_key. `size` is the number of bytes of the key so far,
// initially 0.
bool vertex_lighting_key(struct gl_frame *f, struct gl_vertex_lighting *row, const struct gl_mesh *mesh, int number,
                         size_t *size, lam_error *error);

#endif
