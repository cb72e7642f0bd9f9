// corner_weld.h: which corners of a mesh have the same position, normal and texture coordinates.
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

// The items that are welded: the mesh's vertices, where one index serves the three attributes, else its corners.
struct corner_weld {
    const uint32_t *vertices; // the item of each corner; NULL: corner i is item i
    uint32_t items;
    uint32_t *first; // of each item the first item that is equal to it: itself, or one before it
};

// The number that equal corners share, below `items`.
static inline uint32_t corner_weld_of(const struct corner_weld *weld, size_t corner)
{
    return weld->first[weld->vertices ? weld->vertices[corner] : (uint32_t)corner];
}

// Numbers are compared as floats: −0 equals 0. Normals and texture coordinates that the mesh lacks are all equal. n·log n steps at worst, n
// for files that were not made to collide. `memory` holds the result and the scratch memory.
bool corner_weld(struct corner_weld *weld, const lam_mesh *mesh, struct arena *memory, struct call_control *call,
                 lam_error *error);

#endif
