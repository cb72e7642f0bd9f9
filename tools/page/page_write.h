// page_write.h: `lambent MODEL -o page.html`: writes the one-file page with the model and the command line.
#ifndef PAGE_WRITE_H
#define PAGE_WRITE_H

#include "job.h"

// The maximum size in bytes of a model and of all files that the model uses.
enum { PAGE_FILES_MAX = 100000000 };

// Returns whether the job's output is a page.
bool page_wanted(const struct job *job);

// Replaces job_run for a page. Draws the picture, to detect errors in the model or the options, and writes the page.
// Fails like job_run. Also fails with LAM_UNSUPPORTED if no page is installed or a file is outside the model's folder,
// and with LAM_LIMIT for more than PAGE_FILES_MAX bytes.
bool page_run(struct job *job, struct progress *progress, lam_error *error);

// Reports that a page shows only one picture (LAM_BAD_ARGUMENT), and returns false.
bool page_refuse_several(lam_error *error);

#endif
