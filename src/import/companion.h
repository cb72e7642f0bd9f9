// companion.h: files that a model names, opened beside it or through the caller's function.
#ifndef COMPANION_H
#define COMPANION_H

#include "importer.h"

// The state behind import_source.open and .open_model.
struct companions {
    const char *model; // path of the model; NULL: the model came from memory
    lam_open_fn *open; // the caller's function; NULL: files are opened beside the model
    lam_release_fn *release;
    void *user;
};

// import_source.open and import_source.open_model.
bool companion_open(const struct import_source *source, const char *name, struct file_bytes *out, lam_error *error);
bool companion_open_model(const struct import_source *source, const char *name, struct arena *arena, const char **path,
                          struct file_bytes *out, lam_error *error);

// A name that stays within a folder: as the file has it, with slashes for backslashes, cut to its last part where it
// begins at a root or drive, or contains "..". False: `capacity` is too small.
bool confine(const char *name, char *out, size_t capacity);

#endif
