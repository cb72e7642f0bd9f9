// batch_sandbox.h: sets up the sandbox of a batch: the folders that it reads, and the files that its writer process
// writes.
#ifndef BATCH_SANDBOX_H
#define BATCH_SANDBOX_H

#include "batch_work.h"

// Creates the folders for pictures, journal and page. The folders of the pictures must exist before the process enters
// the sandbox. Fails with LAM_CANNOT_WRITE.
bool batch_sandbox_make_folders(const struct batch *batch, const char *journal, lam_error *error);

// Enters the sandbox for `count` models from `first` on, and starts a writer for their pictures if no writer is
// running. Call this function before starting threads. Fails like sandbox_start.
bool batch_sandbox_enter(const struct batch *batch, size_t first, size_t count, lam_error *error);

// Starts the writer for a process that draws one task. Fails with LAM_LIMIT.
bool batch_sandbox_start_writer(const struct batch *batch, const struct batch_task *task, lam_error *error);

// Enters the sandbox of a process that draws one job: the process may access the folders of the job's model and
// pictures, but no other folder of --allow-path.
bool batch_sandbox_enter_job(const struct batch_job *job, lam_error *error);

#endif
