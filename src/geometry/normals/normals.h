// normals.h: computes normals for meshes without normals.
#ifndef NORMALS_H
#define NORMALS_H

#include "arena.h"
#include "pool.h"
#include "call_control.h"

#include <lambent/mesh.h>

// Computes smooth normals (conventions 18). Corners at the same position (bit-equal after −0 → 0, regardless of their
// indices) are welded. Around a position, two triangles are joined if they share an edge, their face normals differ by
// at most the crease angle and, if groups are given, they have the same smoothing group, which is not 0. A corner's
// normal is the sum over its joined fan of unit face normals, each weighted by the triangle's area × the angle at the
// corner, in triangle order. (With the angle alone, the slivers of CAD files, whose normals are mostly rounding errors,
// would have as much weight as the faces beside them, and surfaces would show streaks.) A triangle without area adds
// nothing, and its corners get their neighbours' normal, or else zero. Neighbours whose common edge has the same
// direction in both (inconsistent winding) are never joined.
//
// A vertex is closed if three to eight corners use its index and each edge that starts there, comparing its ends by
// position, belongs to exactly two of their triangles, in opposite directions. The corners of a closed vertex are not
// welded to other vertices, so that closed surfaces at the same position do not affect each other; an open vertex is
// still welded to all corners at its position. Meshes with fewer than three corners per vertex have no closed vertices.
//
// A crease angle of at most FACET_CREASE_RAD splits at every edge: the normals are facet normals.
//
// The function fills mesh->normals, normal_count and normal_indices from `arena`. The result does not depend on the
// pool.
bool normals_smooth(lam_mesh *mesh, double crease_angle_rad, struct arena *arena, struct pool *pool,
                    struct call_control *call, lam_error *error);

#define FACET_CREASE_RAD 1e-6

// Computes facet normals: each triangle's own at its three corners; a triangle without area gets zero.
bool normals_facet(lam_mesh *mesh, struct arena *arena, struct pool *pool, struct call_control *call, lam_error *error);

#endif
