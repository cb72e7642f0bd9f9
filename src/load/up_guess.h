// up_guess.h: guesses the up axis of a model whose format defines none, if the shape is unambiguous.
#ifndef UP_GUESS_H
#define UP_GUESS_H

#include "scene_internal.h"

// Returns whether a model that was read with y up is a terrain in the plane of x and y: thin along z, and open, so that
// nearly all of its area faces +z, with slopes. (A closed surface faces all sides equally.) It examines all triangles,
// but only if the model is thin along z.
bool is_terrain_on_z(const struct lam_scene *scene);

#endif
