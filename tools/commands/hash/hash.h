// hash.h: the state of the command `hash`.
#ifndef HASH_H
#define HASH_H

#include "batch_shard.h"
#include "batch_work.h"
#include "options.h"

#include <lambent/image.h>

// --- reads and writes the file of `lambent hash`. The file contains a header, and a line for each picture.
//
//     lambent hashes 1
//     version 0.9.0
//     options --size 256
//     pixels:0123456789abcdef  models/koala.obj
//
// A name is relative to the file's folder. In a name, "\\" means a backslash, "\n" a line end and "\r" a carriage
// return.

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

// --- the command

enum { SHEET_ROWS = 40 };

struct hash_run {
    const struct options *options;
    const char *path;        // the hash file; "-" is standard output
    bool checks;             // compares with the file
    struct hash_file then;   // the old contents of the file; empty unless `checks`
    struct hash_file now;    // the new contents
    struct batch_plan plan;  // the models
    char **names;            // the models' names in the file, allocated with malloc
    bool by_file;            // the hash file, not the command line, names the models
    struct hash_file sorted; // `names`, sorted
    bool *kept;              // for each entry of the file: the model exists but is not in the plan
    char *sheet;             // the path of the sheet for --update, allocated with malloc
    atomic_int *rows;        // the number of pictures kept for the sheet of --update
};

// Copies the options of the command line to `own`. If none of them changes the picture, adds the options from the hash
// file. `own` contains pointers into the text *kept. The caller frees both, even after a failure. Fails with
// LAM_CANNOT_READ or LAM_LIMIT.
bool hash_options_take(const struct hash_file *file, const char *path, const struct options *given, struct options *own,
                       char **kept, lam_error *error);

// Returns the options that change the picture as a command line, allocated with malloc. File names in the options
// become relative to the folder of the hash file (`path`). Returns NULL if memory runs out.
char *hash_options_text(const struct options *options, const char *path);

// hash_sheet.c

// Returns the path of the sheet for a hash file in the same folder, such as "pictures-changes.png", allocated with
// malloc. Returns NULL if memory runs out.
char *hash_sheet_path(const char *file);

// Returns the path of a kept picture (--pictures), such as "DIR/models/koala.obj.png", allocated with malloc. Returns
// NULL if memory runs out.
char *hash_picture_path(const char *folder, const char *name);

// If the sheet still has a free row, stores a model's new and old pictures in `found`. The old picture is from
// --pictures.
void hash_sheet_keep(const struct hash_run *run, const char *name, uint64_t recorded, const lam_image *picture,
                     json_t *found);

// Writes the sheet of the pictures in the records. Sets *rows to the number of pictures; if *rows is 0, no sheet was
// written.
bool hash_sheet_write(const struct hash_run *run, json_t *const *records, int *rows, lam_error *error);

// Returns the XXH64 of a picture's pixels: rows from the top, with red, green, blue and alpha for each pixel. The
// picture must be LAM_RGBA8 without padding.
uint64_t hash_of_pixels(const lam_image *image);

#endif
