// batch_job.h: one job of --jobs: the request of a line, with its options, plan and model.
#ifndef BATCH_JOB_H
#define BATCH_JOB_H

#include <jansson.h>

#include "batch_plan.h"
#include "job_roots.h"

struct batch_job {
    struct batch_job *next; // in a list of jobs
    json_t *id;             // a string or an integer
    struct options options; // the worker's, followed by the job's
    char **words;           // which the options point into
    int word_count;
    struct batch_plan plan; // of one model
    lam_bytes bytes;        // the model's; data NULL: a file
    bool in_answer;         // the pictures' files are part of the answer
    char *output;           // that the options point to
    char *options_text;     // for keys; NULL: there are none
    lam_cancel cancel;      // set to cancel it
    bool cancelled;         // it was
};

// Settings of all jobs.
struct batch_job_rules {
    const struct options *options; // the worker's
    int threads, in_flight;        // of each job; jobs that are drawn at once
    const struct job_roots *roots; // where files may lie
    bool has_keys;                 // there is a journal
};

// The kind of a line. REFUSED: it is not valid; `error` has the reason.
enum batch_line { LINE_JOB, LINE_CANCEL, LINE_REFUSED };

// Reads a line of JSON. *id: of the job, or of the job to cancel, also for refused jobs, or NULL if it has none. The
// caller calls json_decref, and frees the job.
enum batch_line batch_job_read(const char *line, size_t size, const struct batch_job_rules *rules,
                               struct batch_job **job, json_t **id, lam_error *error);

void batch_job_free(struct batch_job *job); // NULL is fine

#endif
