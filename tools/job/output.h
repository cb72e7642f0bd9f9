// output.h: where a picture goes, and whether it may.
#ifndef OUTPUT_H
#define OUTPUT_H

#include <lambent/lambent.h>

// Whether --output names the picture itself: neither left out (NULL) nor a folder ("thumbs/").
bool output_is_named(const char *output);

// Where the picture of a model goes, from malloc: where `output` names it, that; else the model's name with
// .png in that folder or the current one: "dir/koala.obj" gives "koala.png", "-" gives "model.png". NULL when
// memory is out.
char *output_path(const char *output, const char *model);

// Whether `path` can be written, as far as can be told before the work is done: its folder is there and may be written,
// it is no folder itself, and, where the user did not name it (`named` false), it is not somebody else's.
bool output_check(const char *path, const char *model, bool named, lam_error *error);

// Whether a picture is written straight to `path` as a PNG: "-", or a pipe or device whose name has no
// picture's ending.
bool output_is_stream(const char *path);

// Writes to such a path; LAM_CANNOT_WRITE.
bool output_write(const char *path, const lam_bytes *bytes, lam_error *error);

// Writes a file beside the target under another name, then renames it: it appears whole or not at all.
// LAM_CANNOT_WRITE.
bool output_replace(const char *path, const lam_bytes *bytes, lam_error *error);

// Bytes of the file at `path`; 0 where it is none.
uint64_t output_size(const char *path);

#endif
