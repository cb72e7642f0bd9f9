// batch_plan.h: which models are drawn, from which sides, in which sizes, and the names of their pictures.
#ifndef BATCH_PLAN_H
#define BATCH_PLAN_H

#include "batch_shard.h"
#include "job.h"

struct batch_model {
    char *path; // from malloc
    char *root; // {dir} is below this folder; from malloc; NULL: the path's own folder
    // A link found in a folder, to a file that lies neither below that folder nor below one of --allow-path: it is an error,
    // since nobody named the file.
    bool leads_out;
};

struct batch_plan {
    const struct options *options;
    struct batch_model *models;
    size_t count, capacity;
    struct job_view views[VIEWS_MAX * VIEWS_MAX]; // of each model
    int view_count;
    char *pattern;            // of the names; NULL: the model's
    struct batch_shard shard; // --shard
    bool by_list;             // --shard-by list: only the models of this shard are added
    size_t listed;            // models that came from lists
    uint64_t list_bytes;      // with by_list: the size of the list
};

// A plan without models. Checks the options that belong together. Error: LAM_BAD_ARGUMENT.
bool batch_plan_start(struct batch_plan *plan, const struct options *options, lam_error *error);

// Adds a model; `root` may be NULL. Both are copied. Fails with LAM_LIMIT.
bool batch_plan_add(struct batch_plan *plan, const char *path, const char *root, lam_error *error);

// Takes the last model away.
void batch_plan_drop_last(struct batch_plan *plan);

// Ends the adding. Finds two pictures of one name, of any shard, and names that cannot be written; then keeps the models of this
// shard. Error: LAM_BAD_ARGUMENT, LAM_UNSUPPORTED.
bool batch_plan_check(struct batch_plan *plan, lam_error *error);

// Returns the path of a picture, from malloc. Returns NULL if memory runs out.
char *batch_plan_output(const struct batch_plan *plan, size_t model, int view);

// Returns the folder that all pictures lie below, with its '/' ("": the current one), from malloc. Returns NULL if
// memory runs out.
char *batch_plan_folder(const struct batch_plan *plan);

void batch_plan_free(struct batch_plan *plan);

#endif
