// batch.h: the loop over models that `lambent A B` and `lambent batch` share (docs/batch.md).
#ifndef BATCH_H
#define BATCH_H

#include "batch_shard.h"
#include "batch_work.h"
#include "batch_job.h"

#include <jansson.h>
#include <pthread.h>

// Draws the planned models and writes the journal and the page. `journal` is the path of the journal, or NULL. Prints
// the messages of `batch` (errors and a summary) if `is_batch` is set, and otherwise the messages of `render`. Returns
// the program's exit code.
int batch_run(const struct batch_plan *plan, const char *journal, bool is_batch);

// Draws the planned models with `use->draw`. Errors are printed in
// the order of the models. Returns the result of `use->finish`, or the exit code of an error that ended the run.
int batch_receive(const struct batch_plan *plan, const struct batch_receiver *use);

// --- runs one pass over the models: selects the next model, and processes the results of finished models.

// Begins a pass. Pass 0 covers all models that have not been drawn. Later passes cover the failed models that may be
// retried. Returns false if there is nothing to do, or after an interrupt.
bool batch_begin_pass(struct batch *batch, int pass);

// Begins a pass over the models that a killed run was drawing, and removes the temporary files of its processes.
// Returns false if there are no such models.
bool batch_begin_suspects(struct batch *batch);
void batch_end_suspects(struct batch *batch);

// Gets the next model of the pass, or the next job. Waits for a job if `waits` is set. Returns false if there is no
// next model or job, or if the batch must not start any more models. Any thread may call this function.
bool batch_take(struct batch *batch, struct batch_task *task, bool waits);

// Processes the results of the work on a model: updates counters, writes journal lines and messages, and answers the job. Any thread
// may call this function.
void batch_deliver(struct batch *batch, struct batch_work *work);

// Removes the temporary files that a killed process left beside a model's pictures. `host` is the machine of the
// process; NULL means this machine.
void batch_remove_parts(const struct batch_plan *plan, size_t model, int process, const char *host);

// --- writes the answers of --jobs to standard output: one line of JSON for each job.

// Any thread may write an answer. Lines are written completely, one after the other.
struct job_answers {
    pthread_mutex_t lock;
    int failure; // the errno of the first failed write, after which nothing is written; accessed atomically
};

void job_answers_start(struct job_answers *answers);
void job_answers_end(struct job_answers *answers);

// Answers a drawn job with the results of its pictures.
void job_answer_work(struct job_answers *answers, const struct batch_work *work);

// Answers a line for which nothing is drawn. A NULL `id` is written as null. `line` is the line number; 0 is not
// reported.
void job_answer_error(struct job_answers *answers, json_t *id, uint64_t line, const char *outcome,
                      const lam_error *error);

// job_answers_fail records that answers can no longer be written; `reason` is the errno. job_answers_failure returns
// the recorded errno, or 0.
void job_answers_fail(struct job_answers *answers, int reason);
int job_answers_failure(const struct job_answers *answers);

// --- writes the page of --report, which shows all pictures of a batch, failures first.

// Makes the thumbnails of a model's pictures, in the folder beside the page. Any thread may call this function. Errors
// are ignored.
void batch_page_thumbnails(const struct batch *batch, const struct batch_work *work);

// Returns whether a thumbnail is missing, or older than its picture.
bool batch_page_lacks(const struct batch *batch, const struct batch_work *work);

// Makes the thumbnail of one picture if `is_new` is set or if no up-to-date thumbnail exists.
void batch_page_thumbnail(const char *page, const char *output, bool is_new);

// Returns the path of a record's picture, allocated with malloc. The path of a journal that others may have written
// (`own` is false) must be below the folder of the page; otherwise the result is NULL.
char *batch_page_output(const char *page, bool own, const json_t *record);

// Returns whether a path may be a thumbnail of the page.
bool batch_page_is_thumbnail(const char *page, const char *path);

struct batch_page {
    const char *path;
    const struct batch_tally *tally;
    // returns a picture's journal line or NULL; the caller releases it
    json_t *(*record)(void *user, size_t index);
    void *user;
    bool own; // the run itself made the records
    size_t record_count;
};

// Writes the page. Fails with LAM_CANNOT_WRITE or LAM_LIMIT.
bool batch_page_write(const struct batch_page *page, lam_error *error);

// --- implements --jobs. Jobs arrive as lines of JSON and wait for a worker. The program answers each job with one line
// (docs/worker.md).
//
// The main thread reads lines; workers take jobs and answer them, in any order. The main thread stops reading while
// `--ahead` jobs are waiting. A job is waiting, being drawn, or answered; at most one job per id is waiting or being
// drawn.

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
void batch_jobs_answer(struct batch_jobs *jobs, struct batch_work *work);

// --- draws each model of a pass in a separate process.

// Draws the models of the pass, batch->workers at a time. This process must have no other thread.
void batch_isolate(struct batch *batch);

#endif
