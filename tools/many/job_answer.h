// job_answer.h: the answers of --jobs: a line of JSON for each job, on standard output.
#ifndef JOB_ANSWER_H
#define JOB_ANSWER_H

#include <jansson.h>
#include <pthread.h>

#include "batch_unit.h"

// Lines are written whole, one after the other, by any thread.
struct job_answers {
    pthread_mutex_t lock;
    int failure; // errno of the first failed write; nothing is written after it. Accessed atomically.
};

void job_answers_start(struct job_answers *answers);
void job_answers_end(struct job_answers *answers);

// The answer to a drawn job: the results of its pictures.
void job_answer_unit(struct job_answers *answers, const struct batch_unit *unit);

// The answer to a line that draws nothing. `id` NULL: null. `line`: of the input; 0: it is not named.
void job_answer_error(struct job_answers *answers, json_t *id, uint64_t line, const char *outcome,
                      const lam_error *error);

// Nobody reads answers any more; and whether that is so: errno, 0: no.
void job_answers_fail(struct job_answers *answers, int reason);
int job_answers_failure(const struct job_answers *answers);

#endif
