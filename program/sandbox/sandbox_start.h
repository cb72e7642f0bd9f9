// sandbox_start.h: sets up the sandbox of a command that reads untrusted files: --sandbox and --allow-path.
//
//     struct sandbox_paths paths = {0};
//     sandbox_add_input(&paths, model);
//     sandbox_add_output(&paths, picture);
//     if (!sandbox_start(options, &paths, error)) …
#ifndef SANDBOX_START_H
#define SANDBOX_START_H

#include "options.h"
#include "sandbox.h"

// Holds the folders that the user names: the folders of the operands, of --allow-path, and of the files that options name
// (lam_path_hold). With --isolate, --jobs and --sandbox require, no link below these folders is followed. Must be called
// before the command reads anything. Fails with LAM_MACHINE.
bool sandbox_hold(const struct options *options, char **operands, int count, lam_error *error);

// Allows reading a model and its folder with all subfolders. "-" and names of shapes need no permission.
void sandbox_add_input(struct sandbox_paths *paths, const char *model);

// Allows reading a single file: an input of `diff`, or an environment.
void sandbox_add_file(struct sandbox_paths *paths, const char *file);

// Allows the writer to create or replace a file, in a folder that may not exist yet. With `by_model`, the name comes
// from the model, and only a file written by Lambent may be replaced. The process in the sandbox opens pipes and
// devices itself. "-" needs no permission.
void sandbox_add_output(struct sandbox_paths *paths, const char *path, bool by_model);

// Allows access to the files that options name: environments, looks, the font, --allow-path and --save-scene.
// sandbox_start calls this function for its own options.
void sandbox_add_options(struct sandbox_paths *paths, const struct options *options);

// Allows this process to read an older picture or open a pipe. paths->may_write decides whether the file may be
// written.
void sandbox_add_older(struct sandbox_paths *paths, const char *path);

// Returns whether sandbox_start would enter a sandbox.
bool sandbox_is_wanted(const struct options *options);

// Starts the writer unless it already runs or nothing may be written. Then enters the sandbox selected by the options.
// The sandbox allows access to the given paths, the options' paths, and the system's libraries and fonts. Always frees
// `paths`. Must be called before threads start. Fails with LAM_UNSUPPORTED if --sandbox require is set and a protection
// is missing, and with LAM_LIMIT if the sandbox or the writer cannot be started.
bool sandbox_start(const struct options *options, struct sandbox_paths *paths, lam_error *error);

// Returns the protections that are active in this process. Before sandbox_start, no protection is active.
const struct sandbox_state *sandbox_active(void);

// Returns a hint for the message if the sandbox may have caused the error, otherwise "".
const char *sandbox_advice(const lam_error *error);

#endif
