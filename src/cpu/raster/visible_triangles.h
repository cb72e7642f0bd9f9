// visible_triangles.h: frames that make normals (frame.h): finds the visible triangles, and makes their normals.
#ifndef VISIBLE_TRIANGLES_H
#define VISIBLE_TRIANGLES_H

#include "arena.h"
#include "buffer.h"

struct cpu_frame;

// Memory of the device. It lasts from frame to frame, except for the fragment stores.
struct visible_buffers {
    struct buffer sets, normals, fragment_stores;
    struct buffer *vertices; // of the device: normals may lie there once the tiles are searched
    struct arena *arenas;    // of each thread, for the fragment stores
    double search_ms;        // of the last frame: finding the visible triangles of each tile
};

// If all surfaces are opaque, each tile's fragments are found on the way and kept; otherwise every binned triangle
// counts as visible.
bool make_normals_of_visible(struct cpu_frame *cpu, struct visible_buffers *buffers, lam_error *error);
void visible_buffers_empty(struct visible_buffers *buffers, int threads); // frees the fragment stores

#endif
