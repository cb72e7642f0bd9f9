// job_inputs.h: keeps the files that a model was read from: no output may replace one.
#ifndef JOB_INPUTS_H
#define JOB_INPUTS_H

#include <lambent/lambent.h>

// Returns whether writing `path` would leave the files as they are that the scene was read from. Fails with LAM_BAD_ARGUMENT. A scene
// file itself may be replaced by another one (`own`), the files that it names may not.
bool job_check_inputs(const lam_scene *scene, const char *path, bool own, lam_error *error);

// Returns whether both paths lead to one file that exists.
bool job_is_same_file(const char *a, const char *b);

#endif
