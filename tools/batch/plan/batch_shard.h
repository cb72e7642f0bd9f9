// batch_shard.h: implements --shard: selects this process's models if several processes share the work.
#ifndef BATCH_SHARD_H
#define BATCH_SHARD_H

#include "job.h"

#include <jansson.h>
#include "options.h"

// Shard `number` of `count`, counted from 1. If both are 0, there are no shards.
struct batch_shard {
    int number, count;
};

// Parses the value of --shard: "K/N", "auto/N" or "auto". With "auto/N", K is read from the environment of Slurm,
// Kubernetes or Open MPI; with "auto", both numbers are. Fails with LAM_BAD_ARGUMENT if there is no such shard, or if
// the environment does not determine the shard.
bool batch_shard_of(const char *text, struct batch_shard *shard, lam_error *error);

// Returns the name that determines a model's shard, allocated with malloc. The name is the path relative to `root`, or
// the whole path if `root` is NULL. The name contains no components "." or "..", no doubled slashes and no leading
// slash. Returns NULL if memory runs out.
char *batch_shard_name(const char *path, const char *root);

// Returns the shard of a name, counted from 1: XXH64 of the name's bytes, modulo `count`, plus 1.
int batch_shard_of_name(const char *name, int count);

// Returns the path of a shard's own file, allocated with malloc: "lambent-017-of-300.jsonl" for "lambent.jsonl".
// Returns NULL if memory runs out.
char *batch_shard_path(const char *path, const struct batch_shard *shard);

// Returns the number of shards that a file name states (300 for "lambent-017-of-300.jsonl"), or 0 if the name states no
// number.
int batch_shard_count_of(const char *path);

// Fails with LAM_BAD_ARGUMENT if the folder of `path` contains files for another number of shards. Otherwise, two
// shards could draw the same models. `path` is the path without a shard, such as "lambent.jsonl".
bool batch_shard_check_folder(const char *path, const struct batch_shard *shard, lam_error *error);

// --- the models to draw, and the views, sizes and names of their pictures.

struct batch_model {
    char *path; // allocated with malloc
    char *root; // the folder to which {dir} is relative, allocated with malloc; NULL means the path's own folder
};

struct batch_plan {
    const struct options *options;
    struct batch_model *models;
    size_t count, capacity;
    struct job_view *views; // pictures of each model, allocated with malloc
    int view_count;
    char *pattern;            // the pattern of the names; NULL means the model's name
    struct batch_shard shard; // --shard
    bool by_list;             // --shard-by list: only the models of this shard are added
    size_t listed;            // number of models from lists
    uint64_t list_bytes;      // the size of the list if by_list is set
};

// Reads a file of cameras. Returns a list of texts for lam_camera_parse, or NULL on failure, with LAM_CANNOT_READ.
json_t *cameras_file_read(const char *path, lam_error *error);

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

// Gets the path of a model's file of cameras, allocated with malloc, or NULL if its views are not numbered: transforms.json
// beside the first picture, or STEM-transforms.json if several models share the folder. Returns false if memory runs out.
bool batch_plan_transforms(const struct batch_plan *plan, size_t index, char **path);

void batch_plan_free(struct batch_plan *plan);

// --- collects the models of `batch` from operands, folders with their subfolders, and lists of names.

// Adds the models of an operand: a file, a built-in shape, a folder, "@FILE" or "-" (names on standard input). Fails
// with LAM_CANNOT_READ or LAM_LIMIT.
bool batch_add_operand(struct batch_plan *plan, const char *operand, lam_error *error);

// Adds the models of a folder and its subfolders. Fails with LAM_CANNOT_READ (also if there are no models) or
// LAM_LIMIT.
bool batch_add_folder(struct batch_plan *plan, const char *folder, lam_error *error);

// Like batch_add_folder, but a folder without models is not an error.
bool batch_add_folder_if_any(struct batch_plan *plan, const char *folder, lam_error *error);

// Adds the models of a list with one name per line; "-" means standard input.
bool batch_add_list(struct batch_plan *plan, const char *path, lam_error *error);

#endif
