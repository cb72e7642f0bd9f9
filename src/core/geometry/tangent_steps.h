// tangent_steps.h: finds corners of a mesh with the same position, normal and texture coordinates.
#ifndef TANGENT_STEPS_H
#define TANGENT_STEPS_H

#include "arena.h"
#include "cpu_features.h"

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

// --- finds the triangle across each edge.

enum { NO_CORNER = UINT32_MAX };

static inline uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
static inline uint32_t prev_corner(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

// Edge c is the edge from corner c to the next corner of its triangle. The twin of an edge connects the same welded
// corners in the opposite direction. If more than two triangles share an edge, the first edge of one direction is
// paired with the first of the other, the second with the second, and so on.
struct edge_twins {
    uint32_t *twin; // the twin of each edge, or NO_CORNER
    // The corners of each welded number v, in order: list[first[v]] … list[first[v + 1] − 1].
    uint32_t *first, *list;
};

// Omits triangles whose flags contain a bit of `left_out`: their edges get no twins, and their corners are not in the
// list. `memory` owns the result and the scratch memory.
bool edge_twins(struct edge_twins *edges, const struct corner_weld *weld, uint32_t triangle_count, const uint8_t *flags,
                unsigned left_out, struct arena *memory, struct call_control *call, lam_error *error);

// --- mikkTSpace's calculations for triangles and corners, LANES triangles at a time. The code is compiled once for
// each instruction set (meson.build). All versions give identical results.

// The properties of a triangle that determine its group, as bits.
enum triangle_flags {
    TRIANGLE_PRESERVING = 1,  // the texture is not mirrored
    TRIANGLE_JOINS_ANY = 2,   // the triangle has no direction, and no orientation until a group reaches it
    TRIANGLE_DEGENERATE = 4,  // two of its positions are equal
    TRIANGLE_HAS_A_GROUP = 8, // a corner has a group
};
enum { TRIANGLES_AFTER = 15 }; // the kernels may overwrite this number of flags after the last triangle's flag

struct tangent_kernels {
    // Sets the flags of the triangles from `first` to `end`, except TRIANGLE_HAS_A_GROUP.
    void (*look)(const lam_mesh *mesh, uint32_t first, uint32_t end, uint8_t *flags);
    // Adds the corners of these triangles, in order, to the sums of their groups. For each summand, makes the
    // triangle's ∂p/∂s perpendicular to the normal, normalizes the result, and multiplies it by the angle at the
    // corner. The angle is measured in the plane perpendicular to the normal. The fourth float is the sum of these
    // angles. Corners of triangles with TRIANGLE_DEGENERATE or TRIANGLE_JOINS_ANY add nothing.
    void (*add)(const lam_mesh *mesh, uint32_t first, uint32_t end, const uint8_t *flags, const uint32_t *groups,
                float (*sums)[4]);
};

CPU_VERSIONS(const struct tangent_kernels, tangent_kernels);

#endif
