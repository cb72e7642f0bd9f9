// animate.h: draws the frames of --turntable and --sweep from one loaded scene.
#ifndef ANIMATE_H
#define ANIMATE_H

#include "animate_frame.h"
#include "job.h"

// Checks combinations of animation options. Fails with LAM_BAD_ARGUMENT.
bool animation_check(const struct options *o, lam_error *error);

// Replaces job_run for an animation: loads the model, and draws and writes the frames.
bool animation_run(struct job *job, struct progress *progress, lam_error *error);

// Returns whether `path` names the file of a frame. `pattern` is the file name, with {frame} instead of the frame
// number.
bool animation_is_frame(const struct options *o, const char *pattern, const char *path);

#endif
