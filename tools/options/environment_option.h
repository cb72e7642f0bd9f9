// environment_option.h: the values of --environment, --environment-rotation and --reflectivity.
#ifndef ENVIRONMENT_OPTION_H
#define ENVIRONMENT_OPTION_H

#include "options.h"

// Splits six file names separated by commas. `paths` point into the returned copy, which the caller frees. NULL: there
// are not six.
char *environment_option_faces(const char *text, const char *paths[LAM_FACE_COUNT], lam_error *error);

// The built-in environment of that name; NULL: there is none.
const char *environment_option_built_in(const char *name);

// Loads or makes the environment of --environment and adds it to the scene, turned by --environment-rotation (which
// also turns a scene file's environment); sets the reflectivity of the materials by --reflectivity. Adds a warning to
// a scene whose environment no surface reflects.
bool environment_option_apply(const struct options *options, lam_scene *scene, const lam_control *control,
                              lam_error *error);

#endif
