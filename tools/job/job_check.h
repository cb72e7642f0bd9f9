// job_check.h: checks for options of a picture that exclude each other.
#ifndef JOB_CHECK_H
#define JOB_CHECK_H

#include "options.h"

// Error: LAM_BAD_ARGUMENT.
bool job_check_options(const struct options *options, lam_error *error);

// Returns whether the name is a built-in shape's or selects the formula of the options: "parametric", "implicit".
bool job_model_is_shape(const char *model);

// Returns whether options of formulas belong to the model. Fails with LAM_BAD_ARGUMENT.
bool job_check_formula(const char *model, const struct options *options, lam_error *error);

#endif
