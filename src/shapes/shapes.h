// shapes.h: meshes from formulas: the tessellators that the built-in shapes and the public calls share.
#ifndef SHAPES_H
#define SHAPES_H

#include "arena.h"
#include "call_control.h"

#include <lambent/mesh.h>

// The largest mesh that is made from a formula; more is LAM_LIMIT.
enum { SHAPE_VERTICES_MAX = 1 << 28 };

// Tessellates parametric surfaces into one mesh: positions welded within each surface, normals, tangents and
// texture coordinates (0…1 over each domain) on a grid of their own. shapes_parametric.c says what happens at
// seams and poles.
bool tessellate_parametric(const lam_parametric *surfaces, int count, struct arena *arena, struct call_control *call,
                           lam_mesh *mesh, lam_error *error);

// Tessellates an implicit surface: positions and normals.
bool tessellate_implicit(const lam_implicit *surface, struct arena *arena, struct call_control *call, lam_mesh *mesh,
                         lam_error *error);

// The point of the unit circle after `steps` of `around` steps a turn, from (1, 0) towards (0, 1). Exact at
// quarter turns, and mirrored steps give mirrored bits, so that round shapes close, and are symmetric, to the
// last bit.
struct circle_point {
    double c, s;
};
struct circle_point circle(double steps, double around);

// What a row of the table of built-in shapes (shapes.c) is asked for: `mesh` for a radius of 1. Segments of 0
// stand for the shape's own.
struct shape_request {
    int slices, stacks;
    struct arena *arena;
    struct call_control *call;
    lam_error *error;
};
bool teapot_build(const struct shape_request *request, lam_mesh *mesh);

#endif
