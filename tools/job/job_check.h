// job_check.h: options of a picture that exclude one another.
#ifndef JOB_CHECK_H
#define JOB_CHECK_H

#include "options.h"

// Error: LAM_BAD_ARGUMENT.
bool job_check_options(const struct options *options, lam_error *error);

#endif
