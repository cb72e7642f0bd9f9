// surface_lattice.h: samples the surface of a scene with a fixed lattice of lines. The samples depend only on the
// surface, so decisions about a model do not depend on the order of its triangles or on its division into triangles.
#ifndef SURFACE_LATTICE_H
#define SURFACE_LATTICE_H

#include "scene_internal.h"

// The lines are parallel to the axes of the model and divide the diagonal of its box into LATTICE parts. A triangle
// counts where lines along the axis nearest to its normal pass through it, and each such point represents an equal area
// of the projection along that axis. The lines do not move if lam_scene_transform moves or turns the scene.
struct surface_lattice {
    lam_vec3 low;   // the lowest corner of the box of the visible objects, before the placement
    double spacing; // 0 if the scene has no visible triangles with an extent
};
enum { LATTICE = 64 };

// Points in a row on one triangle.
struct lattice_row {
    int points;
    uint32_t triangle;
    int x, y;            // of the first point, perpendicular to its line
    lam_vec3 normal, at; // of the triangle and of the first point, in the lattice of the object
    // The area vector of a point's share of the surface, in fractions of 2^-16 of a square of the lattice, before the
    // placement of the scene.
    int64_t area[3], size;
    double weight[3], step[3]; // the weights of the corners at the first point, and the change from point to point
};
typedef void lattice_visitor(void *user, const struct lattice_row *row);

struct surface_lattice surface_lattice_of(const struct lam_scene *scene);

// Returns the transform of an object before the placement of the scene.
lam_mat4 unplaced_transform(const struct lam_scene *scene, int object);

// Visits the points on triangles `first` to `end` of an object. Every sum of integers over these points is independent
// of the triangles' order.
void surface_lattice_visit(const struct surface_lattice *lattice, const struct lam_scene *scene, int object,
                           uint32_t first, uint32_t end, lattice_visitor *visitor, void *user);

#endif
