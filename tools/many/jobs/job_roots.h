// job_roots.h: restricts the files of jobs to the folders of --allow-path.
#ifndef JOB_ROOTS_H
#define JOB_ROOTS_H

#include "options.h"

// Checks the folders. Fails with LAM_BAD_ARGUMENT if one is not a folder.
bool job_roots_check(const struct options *options, lam_error *error);

// Returns whether a file is below one of the folders, without a link on the way. The file need not exist. With `writes`,
// the caller will write the file, so the file must not be a pipe or a device. Fails with LAM_CANNOT_WRITE if `writes` is
// set, otherwise with LAM_CANNOT_READ.
bool job_roots_have(const struct options *options, const char *path, bool writes, lam_error *error);

#endif
