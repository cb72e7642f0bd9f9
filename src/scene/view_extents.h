// view_extents.h: how far a scene's vertices reach in the axes of a view.
#ifndef VIEW_EXTENTS_H
#define VIEW_EXTENTS_H

#include <lambent/scene.h>

// The axes of the view: world directions of the picture's right and top, and from the model to the eye.
struct view_axes {
    lam_vec3 right, above, back;
};

// The largest values over all vertices of ±x + kx·z, ±y + ky·z and z, in the axes of the view; k = 0 gives
// the plain box.
enum reach_direction { REACH_RIGHT, REACH_LEFT, REACH_TOP, REACH_BOTTOM, REACH_FRONT, REACH_DIRECTIONS };

struct reach {
    double kx, ky;
    double value[REACH_DIRECTIONS];
};

// All of a reach, for its kx and ky.
void view_extents_find(const lam_scene *scene, const struct view_axes *axes, struct reach *reach);

// The same for another kx (ky): what depends on it.
void reach_across(const lam_scene *scene, const struct view_axes *axes, double kx, struct reach *reach);
void reach_upwards(const lam_scene *scene, const struct view_axes *axes, double ky, struct reach *reach);

#endif
