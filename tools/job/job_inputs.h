// job_inputs.h: prevents outputs from replacing the files of the model.
#ifndef JOB_INPUTS_H
#define JOB_INPUTS_H

#include <lambent/scene.h>

// Returns whether writing `path` would leave the scene's input files unchanged. Fails with LAM_BAD_ARGUMENT. With
// `own`, `path` may be the scene file itself, but not a file that the scene file names.
bool job_check_inputs(const lam_scene *scene, const char *path, bool own, lam_error *error);

// Returns whether both paths refer to the same existing file.
bool job_is_same_file(const char *a, const char *b);

#endif
