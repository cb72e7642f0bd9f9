// companion.h: opens files that a model or a scene file names, beside it or through the caller's function.
#ifndef COMPANION_H
#define COMPANION_H

#include "importer.h"

// The state of import_source.open and .open_of_scene: where files are sought.
struct file_list;
struct companions {
    const char *folder; // of the file that names them, with its '/' (""; the current one); NULL: it has none on disk
    const char *inside; // put before names for `open`: the folder of a model within a scene, with its '/'; "": none
    lam_open_fn *open;  // the caller's function; NULL: files are opened in `folder`
    lam_release_fn *release;
    void *user;
    struct file_list *files; // every path that is looked for is added; NULL: to none
};

// A file that was opened. The caller releases `file`.
struct companion {
    struct file_bytes file;
    const char *path;  // opens it; NULL: it came from the caller's function
    const char *real;  // the same for every way to name the file: its path without links, or its name for the function
    const char *shown; // its name in messages: the folder, and the name shortened by shown_name
};

// import_source.open. The name is confined first (companion_name); the file must lie in the model's folder or below, or in one
// of params->allowed_paths, links followed. The strings of `out` are in `arena`.
bool companion_open(const struct import_source *source, const char *name, struct arena *arena, struct companion *out,
                    lam_error *error);

// import_source.open_of_scene. The file must lie in the scene file's folder or below, links and ".." followed, unless
// params->models_anywhere is set, or in one of params->allowed_paths; one that does not is an error.
bool companion_open_of_scene(const struct import_source *source, const char *name, struct arena *arena,
                             struct companion *out, lam_error *error);

// The companions of a model that a scene file names: `model` was opened by open_of_scene as `name`. The strings are in
// `arena`. Returns false if memory runs out.
bool companions_of_model(const struct import_source *scene, const char *name, const struct companion *model,
                         struct arena *arena, struct companions *out, lam_error *error);

// The name by which a file that the model names is opened. It is confined to the model's folder: backslashes become slashes,
// "." and empty components are removed, ".." removes the component before it, and a name that begins at a root or a
// drive, or leads out of the folder, is cut to its last component, unless it leads to a file of params->allowed_paths.
// So the names of one file in the folder are the same text. *cut: it was. False: nothing is left, or
// COMPANION_NAME_SIZE is too small.
enum { COMPANION_NAME_SIZE = 4096 };
bool companion_name(const struct import_source *source, const char *name, char out[COMPANION_NAME_SIZE], bool *cut);

#endif
