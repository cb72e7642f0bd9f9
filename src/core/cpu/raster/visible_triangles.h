// visible_triangles.h: finds the visible triangles of the whole picture before lighting, for frames that compute
// normals (frame.h) or have ambient occlusion.
#ifndef VISIBLE_TRIANGLES_H
#define VISIBLE_TRIANGLES_H

#include "arena.h"
#include "buffer.h"

struct cpu_frame;

// Memory of the device, kept from frame to frame except for the fragment stores.
struct visible_buffers {
    struct buffer sets, normals, fragment_stores;
    struct buffer *vertices; // the device's vertices; normals may be stored there after the tiles are searched
    struct arena *arenas;    // one arena per thread, for the fragment stores
    double search_ms;        // the time for finding the visible triangles in the last frame
};

// Returns whether cover_in_advance would find each tile's fragments and keep them until they are shaded.
bool keeps_fragments(const struct cpu_frame *cpu);

// Finds the distances of the surfaces (cpu->occlusion), the visible triangles, and the normals of these triangles, each
// only if the frame needs it. If all surfaces are opaque, the search keeps each tile's fragments. Otherwise, the search
// treats every binned triangle as visible.
bool cover_in_advance(struct cpu_frame *cpu, struct visible_buffers *buffers, lam_error *error);
void visible_buffers_empty(struct visible_buffers *buffers, int threads); // frees the fragment stores

#endif
