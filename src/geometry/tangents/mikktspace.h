// mikktspace.h: MikkTSpace's tangents, for which normal maps are baked.
//
// From M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), and glTF 2.0, section 3.7.2.1, which names it:
//
//  1. Corners with the same position, normal and texture coordinates are welded, whatever their indices.
//  2. A triangle has the direction ∂p/∂s and an orientation, the sign of its area in the texture. A triangle without
//     either (the texture coordinates span no area) takes part in no sum and joins its neighbours' groups.
//  3. Around a welded corner the triangles that are joined by shared edges and have the same orientation form a group.
//  4. The tangent of a group is the sum of its triangles' directions, each made perpendicular to the normal and unit,
//     weighted by the triangle's angle at the corner, in the plane perpendicular to the normal. (The angular threshold
//     is 180°: it splits no group.)
//  5. A triangle with two equal positions joins no group and no edges.
//
// A corner that no group reaches takes the tangent of the first corner that is equal to it and has a group. Where there is
// none, or where a group's sum is zero, it is the tangent of meshes without texture coordinates, a direction around the y
// axis; Mikkelsen's code leaves (1, 0, 0) or zero there.
//
// The summands are computed in double and summed as floats, in the order of the corners. The derivatives are in float, as in his
// code: whether they vanish decides about groups.
//
// The bitangent is w·cross(n, t), not made unit.
#ifndef MIKKTSPACE_H
#define MIKKTSPACE_H

#include "arena.h"

#include <lambent/mesh.h>

struct mesh_tangents {
    float *tangents; // 4 per element: unit, perpendicular to the normal; the sign of the bitangent
    uint32_t count;
    uint32_t *indices; // of each corner
};

// Makes the tangents of a mesh with normals and texture coordinates; the results are in `arena`. The bitangent points
// to where the second texture coordinate grows, with `t_down` to where it falls (glTF, whose texture coordinates begin
// at the top of the picture while the green of its normal maps points up).
bool mikktspace(struct mesh_tangents *out, const lam_mesh *mesh, bool t_down, struct arena *arena,
                struct call_control *call, lam_error *error);

#endif
