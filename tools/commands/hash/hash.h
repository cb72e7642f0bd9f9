// hash.h: the state of `lambent hash`, which its files share.
#ifndef HASH_H
#define HASH_H

#include "batch_plan.h"
#include "batch_use.h"
#include "hash_file.h"
#include "shared_count.h"

enum { SHEET_ROWS = 40 };

struct hash_run {
    const struct options *options;
    const char *path;       // the file of hashes; "-": standard output
    bool checks;            // it is compared
    struct hash_file then;  // the file as it was; empty unless `checks`
    struct hash_file now;   // as it is
    struct batch_plan plan; // the models
    char **names;           // of the models, as they stand in the file; from malloc
    bool *kept;             // of the file's entries: not among the models, and they exist; from malloc
    char *sheet;            // --update: the path of the sheet, from malloc
    atomic_int *rows;       // --update: pictures that were kept for it
};

// Copies the options of the command line to `own`, with the file's options if the command line has none that change the picture.
// *kept: the text that `own` refers to, from malloc; the caller frees both, also after a failure. Errors: LAM_CANNOT_READ, LAM_LIMIT.
bool hash_options_take(const struct hash_file *file, const char *path, const struct options *given, struct options *own,
                       char **kept, lam_error *error);

// Returns the options that change the picture, as a command line, from malloc; files that they name are relative to the folder of the
// file of hashes (`path`). Returns NULL if memory runs out.
char *hash_options_text(const struct options *options, const char *path);

// hash_sheet.c

// Returns the path of the sheet beside a file of hashes, from malloc: "pictures-changes.png". Returns NULL if memory
// runs out.
char *hash_sheet_path(const char *file);

// Returns the file of a kept picture (--pictures), from malloc: "DIR/models/koala.obj.png". Returns NULL if memory runs
// out.
char *hash_picture_path(const char *folder, const char *name);

// Keeps, while the sheet has rows for it, the new picture of a model, and the old one that was kept before, for the sheet. `found` gets both.
void hash_sheet_keep(const struct hash_run *run, const char *name, uint64_t recorded, const lam_image *picture,
                     json_t *found);

// Writes the sheet of the pictures that the records have. *rows: how many there are; 0: nothing was written.
bool hash_sheet_write(const struct hash_run *run, json_t *const *records, int *rows, lam_error *error);

// XXH64 of a picture's pixels: rows from the top, red, green, blue and alpha. The picture is LAM_RGBA8 without padding.
uint64_t hash_of_pixels(const lam_image *image);

#endif
