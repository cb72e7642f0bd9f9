// view_files.h: the files that the viewer serves: models and files that models read, in one folder and below it.
//
// A path of the page begins with "/", which is that folder: "/bunny.obj", "/textures/fur.png".
#ifndef VIEW_FILES_H
#define VIEW_FILES_H

#include <lambent/base.h>

struct view_files {
    int folder;         // its handle; −1: nothing is served
    char *prefix;       // the prefix of the page's paths on this machine: "models", "."
    char *model;        // the page's path of the model that the user has named; NULL: a folder
    char *model_path;   // its own path: it may be a link to a file elsewhere
    char **environment; // files of --environment, which may lie anywhere; "/.environment/N-NAME" in the page, N from 1
    int environment_count;
};

// Opens the folder of a model, or a folder. A built-in shape has no files. Errors: LAM_CANNOT_READ, LAM_LIMIT.
bool view_files_start(struct view_files *files, const char *operand, bool is_folder, lam_error *error);
void view_files_free(struct view_files *files);

// Returns the handle of a regular file, from open(). Returns −1 if there is none that may be served: another kind of
// file, a hidden one (its name or a folder's begins with a dot), one outside of the folder, wherever links and ".."
// lead.
int view_files_open(const struct view_files *files, const char *path);

// The same for a folder; "/" is the top. A handle for its attributes alone (O_PATH).
int view_files_open_folder(const struct view_files *files, const char *path);

// Returns the path on this machine, from malloc. Returns NULL if memory runs out.
char *view_files_path(const struct view_files *files, const char *path);

#endif
