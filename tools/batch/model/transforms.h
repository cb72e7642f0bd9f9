// transforms.h: files of cameras as NeRF programs read them: transforms.json.
#ifndef TRANSFORMS_H
#define TRANSFORMS_H

#include "job.h"

// Writes the cameras of a job's views and the names of their pictures. Call this function after job_arrange.
bool transforms_write(const struct job *job, const char *path, char *const *pictures, lam_error *error);

#endif
