// kept_model.h: keeps a model loaded while several pictures of it are drawn.
#ifndef KEPT_MODEL_H
#define KEPT_MODEL_H

#include "job.h"

struct kept_model {
    char *key; // the words that it was loaded by; NULL: none is loaded
    lam_scene *scene;
    bool environment; // it has one of its own
    double read_ms;
};

// Gives the job the model, as it was before any option changed it: loads it, if another one is kept or it was loaded by other options. The
// job has its options, model, device and environments. `progress`: of loading; NULL: nobody watches. Errors of job_load.
bool kept_model_take(struct kept_model *model, struct job *job, struct progress *progress, lam_error *error);

void kept_model_forget(struct kept_model *model);

#endif
