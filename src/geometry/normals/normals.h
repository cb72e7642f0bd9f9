// normals.h: computes normals for meshes without normals.
#ifndef NORMALS_H
#define NORMALS_H

#include "arena.h"
#include "pool.h"
#include "call_control.h"

#include <lambent/mesh.h>

// Smooth normals (conventions 18): corners at the same position (bit-equal after −0 → 0, whatever their index) are
// welded; around a position, two triangles are joined where they share an edge and their face normals differ by at most
// the crease angle (and they are of one smoothing group, not 0, where groups are given); a corner's normal is the sum
// over its joined fan of unit face normals, each weighted by the triangle's area × the angle at the corner, summed in
// triangle order. (By the angle alone, the slivers of CAD files, whose normals are little but rounding, count as much
// as the faces beside them, and surfaces streak.) A triangle without area adds nothing and its corners take their
// neighbours' normal, else zero. Neighbours that run along their common edge in the same direction (inconsistent
// winding) are never joined.
//
// A vertex is closed if three to eight corners name its index and each edge that starts there, its ends compared by
// position, belongs to exactly two of their triangles, which run along it in opposite directions. The corners of a
// closed vertex are not welded to other vertices', so that closed surfaces at the same position leave each other alone;
// a vertex that is not closed is still welded to all corners at its position. Meshes with fewer than three corners per
// vertex have no closed ones.
//
// A crease angle of at most FACET_CREASE_RAD splits at every edge: the normals are facet normals.
//
// Fills mesh->normals, normal_count and normal_indices from `arena`. The result does not depend on the pool.
bool normals_smooth(lam_mesh *mesh, double crease_angle_rad, struct arena *arena, struct pool *pool,
                    struct call_control *call, lam_error *error);

#define FACET_CREASE_RAD 1e-6

// Facet normals: each triangle's own at its three corners; a triangle without area gets zero.
bool normals_facet(lam_mesh *mesh, struct arena *arena, struct pool *pool, struct call_control *call, lam_error *error);

#endif
