// batch_shard.h: --shard: selects this process's models, if several processes share the work.
#ifndef BATCH_SHARD_H
#define BATCH_SHARD_H

#include "options.h"

// Shard `number` of `count`, from 1. All zero: there are no shards.
struct batch_shard {
    int number, count;
};

// The value of --shard: "K/N", or "auto" and "auto/N", which take K from the environment of Slurm, Kubernetes or Open MPI. Error:
// LAM_BAD_ARGUMENT: no such shard, or the environment does not say which.
bool batch_shard_of(const char *text, struct batch_shard *shard, lam_error *error);

// Returns the name that a model's shard follows from, from malloc: its path below `root`, or as it is given (NULL),
// without ".", "..", doubled slashes and a leading one. Returns NULL if memory runs out.
char *batch_shard_name(const char *path, const char *root);

// Returns the shard that a name belongs to, from 1: XXH64 of its bytes, modulo `count`, plus 1.
int batch_shard_of_name(const char *name, int count);

// Returns the path of a file that each shard has for itself, from malloc: "lambent-017-of-300.jsonl" for
// "lambent.jsonl". Returns NULL if memory runs out.
char *batch_shard_path(const char *path, const struct batch_shard *shard);

// The other way: the number of shards that a file name speaks of ("lambent-017-of-300.jsonl"); 0: none.
int batch_shard_count_of(const char *path);

// Refuses to begin where files of another number of shards lie beside `path` (the path without a shard): with them, models
// would be drawn by two shards. Error: LAM_BAD_ARGUMENT.
bool batch_shard_check_folder(const char *path, const struct batch_shard *shard, lam_error *error);

#endif
