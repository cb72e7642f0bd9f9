// batch_jobs.h: implements --jobs. Jobs arrive as lines of JSON and wait for a worker. The program answers each job
// with one line (docs/worker.md).
//
// The main thread reads lines; workers take jobs and answer them, in any order. The main thread stops reading while
// `--ahead` jobs are waiting. A job is waiting, being drawn, or answered; at most one job per id is waiting or being
// drawn.
#ifndef BATCH_JOBS_H
#define BATCH_JOBS_H

#include "batch_unit.h"
#include "job_roots.h"

// Opens the job stream that the batch's options select. Fails with LAM_CANNOT_READ, LAM_BAD_ARGUMENT or LAM_LIMIT.
struct batch_jobs *batch_jobs_open(struct batch *batch, lam_error *error);
void batch_jobs_close(struct batch_jobs *jobs); // NULL is allowed

// Waits up to `wait_ms` for the next line, reads the line, and accepts, rejects or cancels a job. After an interrupt,
// or if the batch has failed or an answer could not be written, cancels all jobs. Call this function only from the main
// thread.
void batch_jobs_step(struct batch_jobs *jobs, int wait_ms);

// Returns the file descriptor to pass to poll() to wait for the next line, or −1 if no line is needed now.
int batch_jobs_wanted(const struct batch_jobs *jobs);

// Returns whether batch_jobs_step can make progress without input.
bool batch_jobs_is_ready(const struct batch_jobs *jobs);

// Returns whether batch_jobs_take would return a job.
bool batch_jobs_waiting(struct batch_jobs *jobs);

// Returns whether no job is waiting and none will arrive.
bool batch_jobs_over(struct batch_jobs *jobs);

// Gets the next waiting job. If `waits` is set, waits until there is a job. Returns false if there is no job. Any
// thread may call this function.
bool batch_jobs_take(struct batch_jobs *jobs, struct batch_task *task, bool waits);

// Answers a job with its result, and frees the job. Any thread may call this function.
void batch_jobs_answer(struct batch_jobs *jobs, struct batch_unit *unit);

#endif
