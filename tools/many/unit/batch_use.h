// batch_use.h: a use of the pictures of many models other than writing them to the plan's files: hashes, comparisons.
//
// The loop over models, its workers, processes, sandbox, messages and counts stay the same; what is found about each model goes into its
// record.
#ifndef BATCH_USE_H
#define BATCH_USE_H

#include <jansson.h>

#include "job.h"
#include "sandbox.h"

struct batch_use {
    // Draws a model of the plan. `job` has its options, model, device and start; the loop reports its warnings and frees it. What is to
    // be kept goes into `found`, an object, which becomes a part of the model's record. Any thread; with --isolate in another process.
    bool (*draw)(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error);
    // Adds what a model needs besides its own folder. NULL: nothing.
    void (*reach)(void *user, size_t model, struct sandbox_paths *paths);
    // The files that may be written. NULL: none.
    writer_rule *right;
    // Takes the records of all models, after the last one; not after an interrupt. `failed`: the number of models that failed. Returns the
    // exit code. The records are the loop's.
    int (*finish)(void *user, json_t *const *records, size_t failed);
    void *user;
};

#endif
