// visible_triangles.h: frames that make normals (frame.h) or have ambient occlusion: covers the whole picture before any of
// it is lit.
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

// Whether each tile's fragments are found in advance and kept until they are lit, if anything is found in advance.
bool keeps_fragments(const struct cpu_frame *cpu);

// Finds the distances of the surfaces (cpu->occlusion), and the visible triangles and their normals, as far as the frame
// needs them. If all surfaces are opaque, each tile's fragments are found on the way and kept; otherwise every binned
// triangle counts as visible.
bool cover_in_advance(struct cpu_frame *cpu, struct visible_buffers *buffers, lam_error *error);
void visible_buffers_empty(struct visible_buffers *buffers, int threads); // frees the fragment stores

#endif
