// kept_model.h: keeps a model loaded while several pictures of it are drawn.
#ifndef KEPT_MODEL_H
#define KEPT_MODEL_H

#include "job.h"

struct kept_model {
    char *key; // the model and its load options; NULL: not loaded
    lam_scene *scene;
    bool environment; // whether it has its own environment
    double read_ms;
};

// Gives the model to the job in its original state: it is loaded if another model, or the same with other options, is
// kept. Options, model, device and environments of the job must be set. `progress`: for loading; NULL: not shown.
// Errors as for job_load.
bool kept_model_take(struct kept_model *model, struct job *job, struct progress *progress, lam_error *error);

void kept_model_forget(struct kept_model *model);

#endif
