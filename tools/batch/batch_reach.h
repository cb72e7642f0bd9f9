// batch_reach.h: the sandbox of a batch: its models' folders, its pictures', the journal's and the page's.
#ifndef BATCH_REACH_H
#define BATCH_REACH_H

#include "batch_state.h"

// Makes the folders that are to be written to, which must be there when the sandbox is entered. Error: LAM_CANNOT_WRITE.
bool batch_reach_make(const struct batch *batch, const char *journal, lam_error *error);

// Enters the sandbox with the models from `first` on, `count` of them. Before threads start. Errors as sandbox_start.
bool batch_reach_enter(const struct batch *batch, const char *journal, size_t first, size_t count, lam_error *error);

// The same for a process that draws one job: its model's folder, its pictures', and nothing else of --allow-path.
bool batch_reach_enter_job(const struct batch_job *job, lam_error *error);

#endif
