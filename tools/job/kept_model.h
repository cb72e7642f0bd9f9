// kept_model.h: keeps a model loaded while several pictures of it are drawn.
#ifndef KEPT_MODEL_H
#define KEPT_MODEL_H

#include "job.h"

struct kept_model {
    char *key; // the model and its load options; NULL if not loaded
    lam_scene *scene;
    bool environment; // whether the scene file sets an environment
    double read_ms;
};

// Passes the model, in its original state, to the job. If the stored model or its load options are different, loads the
// model first. The job's options, model, device and environments must be set. `progress` shows the loading and may be
// NULL. Fails like job_load.
bool kept_model_take(struct kept_model *model, struct job *job, struct progress *progress, lam_error *error);

void kept_model_forget(struct kept_model *model);

#endif
