// batch_use.h: the interface for commands that draw many models but write no pictures, for example to compute hashes or
// to compare models.
//
// These commands share the loop over the models, including its workers, processes, sandbox, messages and counts. The
// results for a model are stored in the model's record.
#ifndef BATCH_USE_H
#define BATCH_USE_H

#include <jansson.h>

#include "job.h"
#include "sandbox.h"

enum { BATCH_USE_FILES = 3 };
struct batch_use {
    // Draws a model of the plan. `job` contains the options, the model, the device and the start time. The loop reports
    // the job's warnings and frees the job. The function stores its results in the object `found`, which becomes part
    // of the model's record. Any thread may call `draw`; with --isolate, the loop calls it in another process.
    bool (*draw)(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error);
    // Adds the paths that a model needs in addition to its own folder. May be NULL.
    void (*reach)(void *user, size_t model, struct sandbox_paths *paths);
    // Decides which files a process in the sandbox may write. NULL allows no files.
    writer_rule *right;
    const char *files[BATCH_USE_FILES]; // these files, and the folders in which it may write; NULL if there are fewer
    // Called after the last model, unless the run was interrupted. Receives the records of all models; `failed` is the
    // number of failed models. Returns the exit code. The loop owns the records.
    int (*finish)(void *user, json_t *const *records, size_t failed);
    void *user;
};

#endif
