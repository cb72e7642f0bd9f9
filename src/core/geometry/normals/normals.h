// normals.h: computes normals for meshes without normals.
#ifndef NORMALS_H
#define NORMALS_H

#include "arena.h"
#include "pool.h"
#include "call_control.h"

#include <lambent/mesh.h>

// Computes smooth normals. Corners at the same position are welded, regardless of their indices. Positions are the same
// if they are bit-equal after −0 is replaced with 0. Around a position, two triangles are joined if they share an edge
// and their face normals differ by at most the crease angle. If the mesh has smoothing groups, the triangles must also
// belong to the same group, and the group must not be 0. A corner's normal is the sum of the unit face normals of its
// joined fan, in triangle order. Each face normal is weighted by the triangle's area × the angle at the corner. (If the
// weight were the angle alone, the slivers of CAD files would have as much weight as the faces beside them. The normals
// of slivers are mostly rounding errors, so surfaces would show streaks.) A triangle without area adds nothing. The
// corners of such a triangle get the normal of their neighbours, or zero if there is no such normal. Two neighbours are
// never joined if their common edge has the same direction in both (inconsistent winding).
//
// A vertex is closed if three to eight corners use its index, and if each edge at the vertex belongs to exactly two of
// these corners' triangles, in opposite directions. The ends of edges are compared by position. The corners of a closed
// vertex are not welded to other vertices, so that closed surfaces at the same position do not affect each other. An
// open vertex is welded to all corners at its position. Meshes with fewer than three corners per vertex have no closed
// vertices.
//
// A crease angle of at most FACET_CREASE_RAD splits the surface at every edge, so the normals are facet normals.
//
// The function sets mesh->normals, normal_count and normal_indices, allocated in `arena`. The result does not depend on
// the pool.
bool normals_smooth(lam_mesh *mesh, double crease_angle_rad, struct arena *arena, struct pool *pool,
                    struct call_control *call, lam_error *error);

#define FACET_CREASE_RAD 1e-6

// Computes facet normals: the three corners of a triangle get the normal of this triangle, or zero if the triangle has
// no area.
bool normals_facet(lam_mesh *mesh, struct arena *arena, struct pool *pool, struct call_control *call, lam_error *error);

#endif
