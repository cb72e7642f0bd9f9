// batch_state.h: the state of a batch: the result of each picture, and the running workers.
#ifndef BATCH_STATE_H
#define BATCH_STATE_H

#include <pthread.h>

#include "batch_item.h"
#include "batch_plan.h"
#include "batch_tell.h"
#include "journal.h"

// The state of a picture.
enum picture_outcome {
    PICTURE_OPEN, // not drawn yet
    PICTURE_WRITTEN,
    PICTURE_SAME,          // --skip-same: the picture is unchanged and is not drawn again
    PICTURE_BEFORE,        // --resume: an earlier run has written the picture
    PICTURE_FAILED,        // failed, but may be retried
    PICTURE_FAILED_BEFORE, // failed in an earlier run and is not retried
};

struct batch_picture {
    uint8_t outcome;   // enum picture_outcome
    uint8_t class;     // for a failed picture, the index of its class in tally.classes
    uint16_t attempts; // attempts so far, including earlier runs
    bool by_machine;   // for a failed picture, whether the machine caused the failure (batch_is_by_machine)
};

struct batch_job;
struct batch_jobs;

// The task of a worker: a model in the batch's plan or in a job's own plan.
struct batch_task {
    const struct batch_plan *plan; // the options, the views and the names
    size_t model;                  // the index in the plan
    const char *options_text;      // the options as text, from which the pictures' keys are computed; or NULL
    struct batch_job *job;         // NULL if the plan belongs to the batch
};

struct batch {
    const struct batch_plan *plan; // with --jobs, this plan contains no models
    const struct options *options;
    bool is_batch;
    char *options_text;          // NULL if there are no keys
    struct batch_jobs *jobs;     // --jobs (batch_jobs.h); NULL if the plan contains all models
    const struct batch_use *use; // receives the pictures; NULL if the pictures are written to files
    enum journal_way way;
    struct journal *journal;
    int workers, threads;                   // threads of each worker
    struct environment_cache *environments; // shared by all models; NULL if each process loads its own

    pthread_mutex_t lock;           // protects the following members
    pthread_cond_t changed;         // signals that a worker is done
    pthread_cond_t moved;           // signals that `next` has reached `read_from`, or that a worker is done
    struct batch_picture *pictures; // the pictures of all models in order
    json_t **records;               // the records of all pictures, in the same order; NULL if not needed
    bool *taken;                    // for each model, whether a worker has taken the model in this pass
    size_t next;                    // the next model that this pass considers
    size_t read_from;               // the position of the thread that reads ahead
    int drawing;                    // the number of busy workers
    struct batch_tally tally;
    struct batch_texts texts;
    int code; // the highest exit code
    bool interrupted;
    bool failed;   // an error has ended the run, so no further model is started
    int stop_code; // the exit code of this error
};

// Returns the states of the pictures of a model in the batch's plan.
static inline struct batch_picture *batch_pictures_of(const struct batch *b, size_t model)
{
    return b->pictures + model * (size_t)b->plan->view_count;
}

// Reports an error after which no further model is started. Any thread may call it.
void batch_stop(struct batch *batch, const lam_error *error);

#endif
