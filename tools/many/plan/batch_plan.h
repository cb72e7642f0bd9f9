// batch_plan.h: the models to draw, and the views, sizes and names of their pictures.
#ifndef BATCH_PLAN_H
#define BATCH_PLAN_H

#include "batch_shard.h"
#include "job.h"

struct batch_model {
    char *path; // allocated with malloc
    char *root; // the folder to which {dir} is relative, allocated with malloc; NULL means the path's own folder
};

struct batch_plan {
    const struct options *options;
    struct batch_model *models;
    size_t count, capacity;
    struct job_view views[VIEWS_MAX * VIEWS_MAX]; // pictures of each model
    int view_count;
    char *pattern;            // the pattern of the names; NULL means the model's name
    struct batch_shard shard; // --shard
    bool by_list;             // --shard-by list: only the models of this shard are added
    size_t listed;            // number of models from lists
    uint64_t list_bytes;      // the size of the list if by_list is set
};

// Starts a plan without models, and checks combinations of options. Fails with LAM_BAD_ARGUMENT.
bool batch_plan_start(struct batch_plan *plan, const struct options *options, lam_error *error);

// Adds a model; `root` may be NULL. Both strings are copied. Fails with LAM_LIMIT.
bool batch_plan_add(struct batch_plan *plan, const char *path, const char *root, lam_error *error);

// Removes the last model.
void batch_plan_drop_last(struct batch_plan *plan);

// Reports that the pictures of models `a` and `b` have the same name. If a and b are equal, the error states that the
// model is listed twice. Returns false.
bool batch_same_output(const char *a, const char *b, const char *output, lam_error *error);

// Completes the plan. Rejects pictures with equal names, even in different shards. Then keeps only the models of this
// shard. Fails with LAM_BAD_ARGUMENT or LAM_LIMIT.
bool batch_plan_check(struct batch_plan *plan, lam_error *error);

// Returns the path of a picture, allocated with malloc. Returns NULL if memory runs out.
char *batch_plan_output(const struct batch_plan *plan, size_t model, int view);

// Returns the path of the folder that contains all pictures, allocated with malloc. The path ends in '/', or is "" for
// the current folder. Returns NULL if memory runs out.
char *batch_plan_folder(const struct batch_plan *plan);

void batch_plan_free(struct batch_plan *plan);

#endif
