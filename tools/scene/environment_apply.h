// environment_apply.h: applies the options for the environment and the reflectivity to a scene.
#ifndef ENVIRONMENT_APPLY_H
#define ENVIRONMENT_APPLY_H

#include "environment_cache.h"
#include "options.h"

// Loads or makes the environment given by --environment or --reflection-map and adds it to the scene, rotated by
// --environment-rotation (which also rotates a scene file's environment). `cache` may be NULL.
bool environment_set(const struct options *options, struct environment_cache *cache, lam_scene *scene,
                     const lam_control *control, lam_error *error);

// Sets the materials' reflectivity from --reflectivity. Adds a warning to the scene if no surface shows the environment.
bool environment_apply(const struct options *options, lam_scene *scene, lam_error *error);

#endif
