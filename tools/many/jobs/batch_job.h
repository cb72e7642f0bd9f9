// batch_job.h: one job of --jobs: the request read from one line, with its options, plan and model.
#ifndef BATCH_JOB_H
#define BATCH_JOB_H

#include <jansson.h>

#include "batch_plan.h"
#include "job_roots.h"

struct batch_job {
    struct batch_job *next; // the next job in a list
    json_t *id;             // a string or an integer
    struct options options; // the options of the worker and of the job
    char **words;           // `options` points into these words
    int word_count;
    struct batch_plan plan; // the plan of one model
    lam_bytes bytes;        // the model's bytes; data is NULL for a file
    bool in_answer;         // the answer contains the pictures' files
    char *output;           // the job's output name, to which `options` points
    char *options_text;     // the options as text, for the pictures' keys; or NULL
    lam_cancel cancel;      // set to cancel the job
    bool cancelled;         // whether the job was cancelled
};

// Settings common to all jobs.
struct batch_job_rules {
    const struct options *options; // the options of the worker
    int threads, in_flight;        // threads per job, and the number of jobs that are drawn at the same time
    bool has_keys;                 // whether there is a journal
};

// The kind of a line. LINE_REFUSED means that the line is invalid; `error` contains the reason.
enum batch_line { LINE_JOB, LINE_CANCEL, LINE_REFUSED };

// Parses a line of JSON. Sets *id to the id in the line, even if the line is refused, and to NULL if the line contains
// no valid id. The line either describes a new job with this id, or cancels the job with this id. The caller calls
// json_decref for the id, and frees the job.
enum batch_line batch_job_read(const char *line, size_t size, const struct batch_job_rules *rules,
                               struct batch_job **job, json_t **id, lam_error *error);

void batch_job_free(struct batch_job *job); // NULL is allowed

#endif
