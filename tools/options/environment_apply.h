// environment_apply.h: a scene's environment and reflectivity by the options.
#ifndef ENVIRONMENT_APPLY_H
#define ENVIRONMENT_APPLY_H

#include "environment_cache.h"
#include "options.h"

// Loads or makes the environment of --environment and adds it to the scene, turned by --environment-rotation (which
// also turns a scene file's environment); sets the reflectivity of the materials by --reflectivity. Adds a warning to
// a scene whose environment no surface reflects. `cache` may be NULL.
bool environment_apply(const struct options *options, struct environment_cache *cache, lam_scene *scene,
                       const lam_control *control, lam_error *error);

#endif
