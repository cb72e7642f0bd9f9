// job_answer.h: writes the answers of --jobs to standard output: one line of JSON for each job.
#ifndef JOB_ANSWER_H
#define JOB_ANSWER_H

#include <jansson.h>
#include <pthread.h>

#include "batch_unit.h"

// Any thread may write an answer. Lines are written completely, one after the other.
struct job_answers {
    pthread_mutex_t lock;
    int failure; // the errno of the first failed write, after which nothing is written; accessed atomically
};

void job_answers_start(struct job_answers *answers);
void job_answers_end(struct job_answers *answers);

// Answers a drawn job with the results of its pictures.
void job_answer_unit(struct job_answers *answers, const struct batch_unit *unit);

// Answers a line for which nothing is drawn. A NULL `id` is written as null. `line` is the line number; 0 is not
// reported.
void job_answer_error(struct job_answers *answers, json_t *id, uint64_t line, const char *outcome,
                      const lam_error *error);

// job_answers_fail records that answers can no longer be written; `reason` is the errno. job_answers_failure returns
// the recorded errno, or 0.
void job_answers_fail(struct job_answers *answers, int reason);
int job_answers_failure(const struct job_answers *answers);

#endif
