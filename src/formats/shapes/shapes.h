// shapes.h: tessellators of parametric and implicit surfaces, for the built-in shapes and the public functions.
#ifndef SHAPES_H
#define SHAPES_H

#include "arena.h"
#include "call_control.h"

#include <lambent/mesh.h>

// The maximum number of vertices of a tessellated mesh. Larger meshes fail with LAM_LIMIT.
enum { SHAPE_VERTICES_MAX = 1 << 28 };

// Arguments of the function that builds a shape as a mesh of radius 1. If a number of segments is 0, the shape's
// default is used.
struct shape_request {
    int slices, stacks;
    struct arena *arena;
    struct call_control *call;
    lam_error *error;
    int threads; // number of threads that compute the surface; 0: one for each processor
};

// Tessellates parametric surfaces into one mesh. Positions are welded within each surface. Normals, tangents and
// texture coordinates (0…1 over each domain) have their own indices. shapes_parametric.c explains seams and poles. With
// several threads, all threads call the functions of the surfaces.
bool tessellate_parametric(const lam_parametric *surfaces, int count, const struct shape_request *request,
                           lam_mesh *mesh);

// Works like tessellate_parametric, but with one thread. Allocates `border` in `scratch`: one byte per vertex, which is
// 1 if the vertex is on a border of its surface.
bool tessellate_bordered(const lam_parametric *surfaces, int count, struct arena *arena, struct call_control *call,
                         lam_mesh *mesh, struct arena *scratch, uint8_t **border, lam_error *error);

// Tessellates an implicit surface: positions and normals.
bool tessellate_implicit(const lam_implicit *surface, struct arena *arena, struct call_control *call, lam_mesh *mesh,
                         lam_error *error);

// Divides the unit circle into `around` steps. Returns the point after `steps` of these steps, from (1, 0) towards (0,
// 1). Quarter turns are exact, and mirrored steps give bit-identical mirrored points, so round shapes are closed and
// symmetric to the last bit.
struct circle_point {
    double c, s;
};
struct circle_point circle(double steps, double around);

bool teapot_build(const struct shape_request *request, lam_mesh *mesh);

// --- the teapot's control points, in bands of adjacent patches.

// A ring of control points around the vertical axis: the ring's radius, the tangential offset of the inner points, and
// the ring's height.
struct teapot_ring {
    double radius, step, height;
};

// A planar ring of control points across the handle or the spout, from a to b in the plane of symmetry.
struct teapot_section {
    double ax, az, bx, bz, width;
};

extern const struct teapot_ring teapot_body[4][4], teapot_lid[2][4];
extern const struct teapot_section teapot_handle[2][4], teapot_spout[2][4];

#endif
