// job_roots.h: restricts the files of jobs to the folders of --allow-path.
#ifndef JOB_ROOTS_H
#define JOB_ROOTS_H

#include "options.h"

struct job_roots {
    char **paths; // the paths after resolving all links, allocated with malloc
    int count;
};

// Resolves the folders. Fails with LAM_BAD_ARGUMENT (not a folder) or LAM_LIMIT.
bool job_roots_start(struct job_roots *roots, const struct options *options, lam_error *error);
void job_roots_free(struct job_roots *roots);

// Resolves links and ".." in a path, and returns whether the file is below one of the folders. The file need not exist.
// With `writes`, the caller will write the file, so the file must not be a pipe, a device or a broken link. Fails with
// LAM_CANNOT_WRITE if `writes` is set, otherwise with LAM_CANNOT_READ.
bool job_roots_have(const struct job_roots *roots, const char *path, bool writes, lam_error *error);

#endif
