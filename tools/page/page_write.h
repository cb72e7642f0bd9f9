// page_write.h: `lambent MODEL -o page.html`: the page in one file with the model and the command line in it.
#ifndef PAGE_WRITE_H
#define PAGE_WRITE_H

#include "job.h"

// The limit for the bytes of a model and of all files that it reads.
enum { PAGE_FILES_MAX = 100000000 };

// Returns whether the job's output is a page.
bool page_wanted(const struct job *job);

// job_run for a page: draws the picture, which finds whatever is wrong with the model or the options, and writes the
// page. Errors: as job_run; LAM_UNSUPPORTED (no page is installed, a file outside the model's folder), LAM_LIMIT (more
// than PAGE_FILES_MAX).
bool page_run(struct job *job, struct progress *progress, lam_error *error);

// The error for several pictures in a page: LAM_BAD_ARGUMENT. Returns false.
bool page_refuse_several(lam_error *error);

#endif
