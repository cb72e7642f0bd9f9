// hash_file.h: reads and writes the file of `lambent hash`. The file contains a header, and a line for each picture.
//
//     lambent hashes 1
//     version 0.9.0
//     options --size 256
//     pixels:0123456789abcdef  models/koala.obj
//
// A name is relative to the file's folder. In a name, "\\" means a backslash, "\n" a line end and "\r" a carriage
// return.
#ifndef HASH_FILE_H
#define HASH_FILE_H

#include <lambent/image.h>

#include "options.h"

enum { HASH_FILE_MAX = 64 << 20 }; // bytes

struct hash_entry {
    char *name; // allocated with malloc
    uint64_t hash;
};

struct hash_file {
    char *version, *options;    // allocated with malloc
    struct hash_entry *entries; // sorted by name
    size_t count;
};

// Reads a regular file of at most HASH_FILE_MAX bytes. The caller frees `file`, even after a failure. Fails with
// LAM_CANNOT_READ or LAM_LIMIT.
bool hash_file_read(struct hash_file *file, const char *path, lam_error *error);
void hash_file_free(struct hash_file *file);

// Returns the entry with this name, or NULL if there is none.
const struct hash_entry *hash_file_find(const struct hash_file *file, const char *name);

// Sorts the entries by name. Names must be unique.
void hash_file_sort(struct hash_file *file);

// Returns the text of the file, allocated with malloc, or NULL if memory runs out.
char *hash_file_text(const struct hash_file *file);

// Returns the name under which the hash file `path` lists a model, allocated with malloc. The name is the model's path
// relative to the folder of `path`, after links are resolved. Names of built-in shapes are unchanged. Returns NULL if
// memory runs out.
char *hash_file_name(const char *path, const char *model);

// Returns the path of the model that the hash file `path` lists under a name, allocated with malloc. Returns NULL if
// memory runs out.
char *hash_file_model(const char *path, const char *name);

// Returns whether the hash file `path` may refer to the model `file` (a path from hash_file_model). Links are resolved
// first. `file` must then be below the folder of `path` or below a folder that --allow-path names. Fails with
// LAM_CANNOT_READ.
bool hash_file_may_name(const char *path, const char *file, const struct options *options, lam_error *error);

#endif
