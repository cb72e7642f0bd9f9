// visible_normals.h: computes normals for some or all triangles of a mesh.
//
// A picture of a large model shows only a few of the model's triangles. The search is limited to corners at the
// positions of visible triangles' corners. The normals at these corners are bit-identical to the normals that are
// computed for the whole mesh.
#ifndef VISIBLE_NORMALS_H
#define VISIBLE_NORMALS_H

#include "pool.h"
#include "normals_memory.h"

#include <lambent/mesh.h>

// Normals for a set of triangles from one or several meshes. The triangles of all meshes are numbered consecutively.
// The normal at corner k of the triangle with rank r in the set is normals[elements[3r + k]].
struct visible_normals {
    struct rank_bitset triangles;
    uint32_t *elements; // 3 · triangles.count
    // Capacity for 3 · triangles.count normals. The first `used` elements contain normals. If corners share normals,
    // `used` is much smaller than the capacity. The order of the normals depends on the threads.
    float (*normals)[3];
    uint32_t used;
    uint32_t *first_corners; // a corner of the mesh for each normal, with the same capacity; NULL if not needed
};

// For corner k of a triangle in the set, returns the index of the normal.
static inline uint32_t visible_element(const struct visible_normals *visible, size_t triangle, uint32_t k)
{
    return visible->elements[3 * (size_t)rank_bitset_rank(&visible->triangles, triangle) + k];
}

// The resources for the computation. These resources do not affect the result.
struct normals_work {
    struct scratch_memory scratch; // memory to reuse, or a zeroed struct
    int lanes;                     // the maximum number of floats that are processed at a time
    struct pool *pool;
    struct call_control *call;
};

// Computes the normals of one mesh by the rule in normals.h. Triangle t of the mesh has the number first + t in the
// set. rank_bitset_finish must have been called for the set. Errors: LAM_LIMIT, LAM_CANCELLED.
bool make_visible_normals(const lam_mesh *mesh, uint32_t first, double crease_angle_rad,
                          struct visible_normals *visible, const struct normals_work *work, lam_error *error);

#endif
