// mikktspace.h: MikkTSpace tangents, which baked normal maps require.
//
// From M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), and glTF 2.0, section 3.7.2.1, which refers
// to this paper:
//
// 1. Corners with the same position, normal and texture coordinates are welded, regardless of their indices.
// 2. A triangle has the direction ∂p/∂s and an orientation, the sign of its area in the texture. A triangle whose
//    texture coordinates span no area has no direction and no orientation. Such a triangle adds nothing to the sums,
//    and joins the groups of its neighbours.
// 3. Around a welded corner, the triangles that are connected by shared edges and have the same orientation form a
//    group.
// 4. The tangent of a group is the sum of its triangles' directions. Each direction is made perpendicular to the
//    normal, normalized, and weighted by the triangle's angle at the corner. The angle is measured in the plane
//    perpendicular to the normal. (The angular threshold is 180°: it splits no group.)
// 5. A triangle with two equal positions joins no group and has no neighbours.
//
// A corner that no group reaches gets the tangent of the first equal corner that has a group. If there is no such
// corner, or if a group's sum is zero, the tangent is the same as in meshes without texture coordinates: a direction
// around the y axis. Mikkelsen's code returns (1, 0, 0) or zero in these cases.
//
// The summands are computed in double and summed as floats, in the order of the corners. The derivatives are floats, as
// in Mikkelsen's code, because the groups depend on whether a derivative is zero.
//
// The bitangent is w·cross(n, t); it is not normalized.
#ifndef MIKKTSPACE_H
#define MIKKTSPACE_H

#include "arena.h"

#include <lambent/mesh.h>

struct mesh_tangents {
    float *tangents; // 4 per element: a unit vector perpendicular to the normal, and the sign of the bitangent
    uint32_t count;
    uint32_t *indices; // the index of each corner
};

// Computes the tangents of a mesh with normals and texture coordinates; the results are in `arena`. The bitangent
// points in the direction in which the second texture coordinate increases or, with `t_down`, decreases. glTF needs
// `t_down`: its texture coordinates begin at the top of the picture, but the green channel of its normal maps points
// up.
bool mikktspace(struct mesh_tangents *out, const lam_mesh *mesh, bool t_down, struct arena *arena,
                struct call_control *call, lam_error *error);

#endif
