// environment_option.h: parses the values of --environment.
#ifndef ENVIRONMENT_OPTION_H
#define ENVIRONMENT_OPTION_H

#include "options.h"

// Splits a list of six file names at its commas. The elements of `paths` point into the returned copy, which the caller
// frees. Returns NULL if `text` does not contain six names.
char *environment_option_faces(const char *text, const char *paths[LAM_FACE_COUNT], lam_error *error);

// Returns the name of the option that has set the environment: "environment" or "reflection-map".
const char *environment_option_name(const struct options *options);

// Returns whether the value removes the environment. `text` may be NULL.
bool environment_option_is_none(const char *text);

// Returns the name of the built-in environment that `name` selects, or "none", as a static string. Returns NULL if
// `name` names files.
const char *environment_option_built_in(const char *name);

// Loads or makes the environment that a value of --environment describes. The caller frees the environment. Returns
// NULL on failure; for the errors see lam_environment_load.
lam_environment *environment_option_load(const char *text, lam_color_mode color, const lam_control *control,
                                         lam_error *error);

#endif
