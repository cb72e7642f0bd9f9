// sandbox_start.h: the sandbox of a command that reads strangers' files: --sandbox and --allow-path.
//
//     struct sandbox_paths paths = {0};
//     sandbox_add_input(&paths, model);
//     sandbox_add_output(&paths, picture);
//     if (!sandbox_start(options, &paths, error)) …
#ifndef SANDBOX_START_H
#define SANDBOX_START_H

#include "options.h"
#include "sandbox.h"

// Allows reading a model, and its folder with all sub-folders. "-" and names of shapes need nothing.
void sandbox_add_input(struct sandbox_paths *paths, const char *model);

// Lets a picture be read, alone: an input of `diff`, an environment.
void sandbox_add_file(struct sandbox_paths *paths, const char *file);

// Lets the writer make or replace a file, in a folder that need not exist yet. `by_model`: the model gave the name, so that only a
// picture of Lambent's is replaced. A pipe or a device is opened inside. "-" needs nothing.
void sandbox_add_output(struct sandbox_paths *paths, const char *path, bool by_model);

// Lets the files be reached that options name: environments, looks, the font, --allow-path, --save-scene. sandbox_start does it for its own.
void sandbox_add_options(struct sandbox_paths *paths, const struct options *options);

// The part of it that concerns this process: an older picture is read, a pipe is opened. paths->may_write decides on the rest.
void sandbox_add_older(struct sandbox_paths *paths, const char *path);

// Returns whether sandbox_start would enter a sandbox.
bool sandbox_is_wanted(const struct options *options);

// Starts the writer, unless it runs already or nothing may be written. Then enters the sandbox of the options, with the
// given paths, the options' paths and the system's libraries and fonts. Frees `paths` in any case. Call it before
// threads start. Fails with LAM_UNSUPPORTED where --sandbox require cannot be had, LAM_LIMIT.
bool sandbox_start(const struct options *options, struct sandbox_paths *paths, lam_error *error);

// Returns the protections in force in this process; none before sandbox_start.
const struct sandbox_state *sandbox_active(void);

// The addition to the error about a file that the sandbox may have blocked; "": none.
const char *sandbox_advice(const lam_error *error);

#endif
