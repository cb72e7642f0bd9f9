// corner_weld.h: finds corners of a mesh with the same position, normal and texture coordinates.
#ifndef CORNER_WELD_H
#define CORNER_WELD_H

#include "arena.h"

#include <lambent/mesh.h>

#include <stdbool.h>
#include <stdint.h>

static inline uint32_t mesh_element(const uint32_t *own, const uint32_t *common, size_t corner)
{
    return own ? own[corner] : common ? common[corner] : (uint32_t)corner;
}

// The items to weld. If all three attributes use the same index, the items are the mesh's vertices; otherwise, the
// items are the mesh's corners.
struct corner_weld {
    uint32_t items;
    const uint32_t *of; // for each corner, the first equal item
};

// Values are compared as floats, so −0 equals 0. Missing normals and texture coordinates are treated as equal. The time
// is proportional to the number n of items, or at most to n·log n for files that were made to cause hash collisions.
// `memory` owns the result and the scratch memory.
bool corner_weld(struct corner_weld *weld, const lam_mesh *mesh, struct arena *memory, struct call_control *call,
                 lam_error *error);

#endif
