// companion.h: files that a model names, opened in its folder or through the caller's function.
#ifndef COMPANION_H
#define COMPANION_H

#include "importer.h"

// The state of import_source.open and .open_model.
struct companions {
    const char *model; // path; NULL: the model came from memory
    lam_open_fn *open; // the caller's function; NULL: files are opened in the model's folder
    lam_release_fn *release;
    void *user;
};

// import_source.open and import_source.open_model.
bool companion_open(const struct import_source *source, const char *name, struct file_bytes *out, lam_error *error);
bool companion_open_model(const struct import_source *source, const char *name, struct arena *arena, const char **path,
                          struct file_bytes *out, lam_error *error);

// Confines a file name to a folder: backslashes become slashes, and a name that begins at a root or a drive, or
// contains "..", is cut to its last component. False: `capacity` is too small.
bool confine(const char *name, char *out, size_t capacity);

#endif
