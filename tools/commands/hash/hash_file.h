// hash_file.h: the file that `lambent hash` writes and reads: a head, and a line for each picture.
//
//     lambent hashes 1
//     version 0.9.0
//     options --size 256
//     pixels:0123456789abcdef  models/koala.obj
//
// A name is relative to the file's folder; in it "\\" means a backslash, "\n" for a line end and "\r" for a carriage return.
#ifndef HASH_FILE_H
#define HASH_FILE_H

#include <lambent/image.h>

struct hash_entry {
    char *name; // from malloc
    uint64_t hash;
};

struct hash_file {
    char *version, *options;    // from malloc
    struct hash_entry *entries; // sorted by their names
    size_t count;
};

// Reads a file. The caller frees it, also after a failure. Errors: LAM_CANNOT_READ, LAM_LIMIT.
bool hash_file_read(struct hash_file *file, const char *path, lam_error *error);
void hash_file_free(struct hash_file *file);

// Returns the entry of a name, or NULL if there is none.
const struct hash_entry *hash_file_find(const struct hash_file *file, const char *name);

// Sorts the entries by their names, each of which is there once.
void hash_file_sort(struct hash_file *file);

// Returns the text of the file, from malloc. Returns NULL if memory runs out.
char *hash_file_text(const struct hash_file *file);

// Returns the name of a model as it stands in the file `path`, from malloc: relative to that file's folder, also if
// either is reached by a link. The name of a built-in shape stays. Returns NULL if memory runs out.
char *hash_file_name(const char *path, const char *model);

// Returns the model that a name in the file `path` means, from malloc. Returns NULL if memory runs out.
char *hash_file_model(const char *path, const char *name);

#endif
