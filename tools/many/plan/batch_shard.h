// batch_shard.h: implements --shard: selects this process's models if several processes share the work.
#ifndef BATCH_SHARD_H
#define BATCH_SHARD_H

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

#endif
