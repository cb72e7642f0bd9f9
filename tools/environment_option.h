// environment_option.h: the values of --environment, --environment-rotation and --reflectivity.
#ifndef ENVIRONMENT_OPTION_H
#define ENVIRONMENT_OPTION_H

#include "options.h"

// Six file names with commas between them, cut apart: `paths` point into the copy that is returned, which the
// caller frees. NULL: there are not six.
char *environment_option_faces(const char *text, const char *paths[LAM_FACE_COUNT], lam_error *error);

// Reads or makes what --environment names; *environment is NULL without that option. The caller frees it.
bool environment_option_load(const struct options *options, lam_environment **environment, lam_error *error);

// Gives it to a scene, turned as asked, and its materials the reflectivity asked for, if one is.
bool environment_option_apply(const struct options *options, const lam_environment *environment,
                              lam_scene *scene, lam_error *error);

#endif
