// view_files.h: opens the files that the viewer serves: models and files that models read, in one folder and below it.
//
// A path of the page begins with "/", which means this folder: "/bunny.obj", "/textures/fur.png".
#ifndef VIEW_FILES_H
#define VIEW_FILES_H

#include <lambent/base.h>

struct view_files {
    char *prefix;       // the path of the page's "/" on this machine: "models", "."; NULL if nothing is served
    char *model;        // the model's path in the page; NULL if a folder is shown
    char *model_path;   // the model's own path, which may be a link to another folder
    char **environment; // files of --environment, in any folder; "/.environment/N-NAME" in the page, N from 1
    int environment_count;
};

// Opens a folder, or the folder of a model. A built-in shape has no files. Fails with LAM_CANNOT_READ or LAM_LIMIT.
bool view_files_start(struct view_files *files, const char *operand, bool is_folder, lam_error *error);
void view_files_free(struct view_files *files);

// Opens a regular file and returns its handle. Returns −1 if the file does not exist or must not be served. The viewer
// serves only models and files that models can refer to, recognised by their extensions. It serves no hidden files, no
// files in hidden folders, and no files outside the folder (after links and ".." are resolved).
int view_files_open(const struct view_files *files, const char *path);

// Opens a folder, with the same checks of its path; "/" is the top folder. The handle allows access only to the
// attributes (O_PATH).
int view_files_open_folder(const struct view_files *files, const char *path);

// Returns the path on this machine, allocated with malloc. Returns NULL if memory runs out.
char *view_files_path(const struct view_files *files, const char *path);

#endif
