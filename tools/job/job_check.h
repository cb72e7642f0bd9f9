// job_check.h: checks picture options that exclude each other.
#ifndef JOB_CHECK_H
#define JOB_CHECK_H

#include "options.h"

// Checks the options. Fails with LAM_BAD_ARGUMENT.
bool job_check_options(const struct options *options, lam_error *error);

// Returns whether `model` names a built-in shape, or selects a formula of the options ("parametric" or "implicit").
bool job_model_is_shape(const char *model);

// Returns whether the formula options match the model. Fails with LAM_BAD_ARGUMENT.
bool job_check_formula(const char *model, const struct options *options, lam_error *error);

#endif
