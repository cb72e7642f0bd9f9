// view_extents.h: extents of a scene's vertices along the axes of a view.
#ifndef VIEW_EXTENTS_H
#define VIEW_EXTENTS_H

#include <lambent/scene.h>

// The axes of the view as directions in world space: to the right and to the top of the picture, and from the model to
// the eye. The coordinates x, y and z of a vertex are measured along these axes from `centre`. This point is near the
// scene, so the coordinates are precise for any position of the scene.
struct view_axes {
    lam_vec3 right, above, back;
    lam_vec3 centre;
};

// The points whose extents are computed.
struct view_points {
    const lam_scene *scene;
    // The extents are the maxima over the scene's vertices and over all of these sets of axes. For a rotating scene,
    // each pose gives one element, because rotating the axes is the same as rotating the scene.
    const struct view_axes *axes;
    int axes_count;
    double ball_radius; // if above 0, a ball of this radius around the centre of the axes is measured instead
};

// The maxima over all points of ±x + kx·z, ±y + ky·z and z, in the axes of the view. With k = 0 this is the bounding
// box.
enum extent_direction { EXTENT_RIGHT, EXTENT_LEFT, EXTENT_TOP, EXTENT_BOTTOM, EXTENT_FRONT, EXTENT_DIRECTIONS };

struct view_extents {
    double kx, ky;
    double value[EXTENT_DIRECTIONS];
    lam_vec3 point[EXTENT_DIRECTIONS]; // x, y and z of the point with the maximum
};

// Gets a point of the scene: the middle of the box of the first object that has triangles. Returns false and sets the
// point to zero if no object has triangles.
bool view_extents_centre(const lam_scene *scene, lam_vec3 *centre);

// Sets all extents for the given kx and ky.
void view_extents_find(const struct view_points *points, struct view_extents *extents);

// These functions set kx or ky, and update the extents that depend on it.
void view_extents_horizontal(const struct view_points *points, double kx, struct view_extents *extents);
void view_extents_vertical(const struct view_points *points, double ky, struct view_extents *extents);

// Gets the smallest and the largest depth of the scene's vertices: the distance in front of the eye, measured along the
// view direction. Returns false if there are no vertices.
bool view_extents_depth(const lam_scene *scene, const lam_mat4 *view, double *nearest, double *farthest);

#endif
