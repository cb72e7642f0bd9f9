// show_all.h: implements --show all: writes the picture and all terms of its light as layers of one EXR picture.
#ifndef SHOW_ALL_H
#define SHOW_ALL_H

#include "job.h"

bool show_is_all(const struct options *options);

// Checks that the output format can store layers. Otherwise, the error says that --show all needs a .exr file.
bool show_all_check(const struct job *job, lam_error *error);

// Draws every term of the job's picture. Writes the terms and the picture, which is already drawn, to the job's output.
bool show_all_write(struct job *job, const lam_control *control, lam_error *error);

#endif
