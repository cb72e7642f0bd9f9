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

// The items to weld: the mesh's vertices, if one index serves the three attributes, otherwise its corners.
struct corner_weld {
    uint32_t items;
    const uint32_t *of; // for each corner the first equal item, which is the same for equal corners
};

// Numbers are compared as floats: −0 equals 0. Missing normals and texture coordinates are all equal. It takes n·log n
// steps at worst, and n for files that were not made to collide. `memory` owns the result and the scratch memory.
bool corner_weld(struct corner_weld *weld, const lam_mesh *mesh, struct arena *memory, struct call_control *call,
                 lam_error *error);

#endif
