// up_guess.h: guesses the up axis of a model whose format defines none, if the shape is unambiguous.
#ifndef UP_GUESS_H
#define UP_GUESS_H

#include "scene_internal.h"

// Returns whether a model that was read with y up is a terrain in the plane of x and y. Such a model is thin along z
// and has slopes, and most of its area faces +z. (A closed surface faces all sides equally.) All triangles are
// examined, but only if the model is thin along z.
bool is_terrain_on_z(const struct lam_scene *scene, struct pool *pool);

#endif
