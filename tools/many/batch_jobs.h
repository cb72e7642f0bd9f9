// batch_jobs.h: --jobs: jobs come as lines of JSON, wait for a worker, and are answered by a line each (docs/worker.md).
//
// The main thread reads lines; workers take jobs and answer them, in any order. Reading stops while `--ahead` jobs wait. A job is
// waiting, being drawn, or answered, and under its id at most one job is waiting or being drawn.
#ifndef BATCH_JOBS_H
#define BATCH_JOBS_H

#include "batch_unit.h"
#include "job_roots.h"

// Opens the stream of jobs that the batch's options name. Fails with LAM_CANNOT_READ, LAM_BAD_ARGUMENT, LAM_LIMIT.
struct batch_jobs *batch_jobs_open(struct batch *batch, lam_error *error);
void batch_jobs_close(struct batch_jobs *jobs); // NULL is fine

// Returns the folders that files of jobs may lie in.
const struct job_roots *batch_jobs_roots(const struct batch_jobs *jobs);

// Reads the next line, waiting for it up to `wait_ms`, and accepts, refuses or cancels a job. After an interrupt, or
// when the batch or the answers have failed, cancels all jobs. The main thread alone.
void batch_jobs_step(struct batch_jobs *jobs, int wait_ms);

// Returns the file to poll() for the next line, or −1 if none is wanted at the moment.
int batch_jobs_wanted(const struct batch_jobs *jobs);

// Returns whether batch_jobs_step has something to do without anything being read.
bool batch_jobs_is_ready(const struct batch_jobs *jobs);

// Returns whether no job waits, and none will.
bool batch_jobs_over(struct batch_jobs *jobs);

// The next job that waits; with `waits` it is waited for. Returns false if there is none. Any thread.
bool batch_jobs_take(struct batch_jobs *jobs, struct batch_task *task, bool waits);

// Answers a job with its result, and frees it. Any thread.
void batch_jobs_answer(struct batch_jobs *jobs, struct batch_unit *unit);

#endif
