// output.h: the path of a picture, checks before writing it, and the writing.
#ifndef OUTPUT_H
#define OUTPUT_H

#include <lambent/lambent.h>

// True if --output names the picture itself: it is neither NULL (not given) nor a folder ("thumbs/").
bool output_is_named(const char *output);

// The path of a model's picture, from malloc: `output` if it names a file; else the model's name with .png in that
// folder or the current one: "dir/koala.obj" gives "koala.png", "-" gives "model.png". NULL: out of memory.
char *output_path(const char *output, const char *model);

// Checks before the work whether `path` can be written: its folder exists and is writable, the path is not a folder,
// and, unless the user named it (`named`), it is not a file that lambent did not write.
bool output_check(const char *path, const char *model, bool named, lam_error *error);

// True if the picture is written directly to `path` as a PNG: "-", or a pipe or device without a picture's extension.
bool output_is_stream(const char *path);

// Writes to a stream, as output_is_stream defines it. Error: LAM_CANNOT_WRITE.
bool output_write(const char *path, const lam_bytes *bytes, lam_error *error);

// Writes a temporary file next to the target and renames it, so that the target is complete or untouched.
// Error: LAM_CANNOT_WRITE.
bool output_replace(const char *path, const lam_bytes *bytes, lam_error *error);

// The size of the file at `path` in bytes; 0 if it is not a file.
uint64_t output_size(const char *path);

#endif
