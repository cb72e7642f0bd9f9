// environment_option.h: the values of --environment, --environment-rotation and --reflectivity.
#ifndef ENVIRONMENT_OPTION_H
#define ENVIRONMENT_OPTION_H

#include "options.h"

// Six file names with commas between them, cut apart: `paths` point into the copy that is returned, which the caller
// frees. NULL: there are not six.
char *environment_option_faces(const char *text, const char *paths[LAM_FACE_COUNT], lam_error *error);

// The built-in environment of that name; NULL: it is none.
const char *environment_option_built_in(const char *name);

// Reads or makes what --environment names and gives it to the scene, turned as --environment-rotation says
// (which also turns a scene file's own), and gives the materials the --reflectivity asked for. Where a scene
// has an environment that no surface reflects, it gets a warning.
bool environment_option_apply(const struct options *options, lam_scene *scene, const lam_control *control,
                              lam_error *error);

#endif
