// batch_reach.h: the sandbox of a batch: the folders that it reads, and the files that its writer writes.
#ifndef BATCH_REACH_H
#define BATCH_REACH_H

#include "batch_state.h"

// Makes the folders of pictures, journal and page; the pictures' must be there when the sandbox is entered. Error: LAM_CANNOT_WRITE.
bool batch_reach_make(const struct batch *batch, const char *journal, lam_error *error);

// Enters the sandbox with the models from `first` on, `count` of them, and starts a writer for their pictures if there is none. Before threads
// start. Errors as sandbox_start.
bool batch_reach_enter(const struct batch *batch, size_t first, size_t count, lam_error *error);

// Starts the writer for a process that draws one task. Error: LAM_LIMIT.
bool batch_reach_write(const struct batch *batch, const struct batch_task *task, lam_error *error);

// Enters the sandbox of a process that draws one job: its model's folder, its pictures', and nothing else of --allow-path.
bool batch_reach_enter_job(const struct batch_job *job, lam_error *error);

#endif
