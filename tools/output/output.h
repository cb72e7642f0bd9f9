// output.h: the path of a picture, checks before writing it, and the writing.
#ifndef OUTPUT_H
#define OUTPUT_H

#include <lambent/lambent.h>

#include "output_folder.h"
#include "output_name.h"

// Returns true if --output names the picture itself: it is neither NULL (not given) nor a folder ("thumbs/").
bool output_is_named(const char *output);

// Returns the path of a picture, from malloc: `output` if it names a file; else the model's name with `ending` in that
// folder or the current one: "dir/koala.obj" gives "koala.png" for ".png" and "koala-terms.png" for "-terms.png", "-"
// gives "model.png". Returns NULL if memory runs out.
char *output_path(const char *output, const char *model, const char *ending);

// Returns the path of a model's picture, from malloc: the name that a pattern gives, else as output_path. Returns NULL
// if memory runs out.
char *output_path_of(const char *output, const struct output_words *words);

// Where the name of a picture comes from: the model's name, alone or in a folder of the user's; a name that the user
// gave; a pattern that the user gave. The first two are false and true of output_is_named.
enum output_given { OUTPUT_BY_MODEL, OUTPUT_NAMED, OUTPUT_PATTERN };
enum output_given output_given(const char *output);

// Checks before the work whether `path` can be written: its folder exists and is writable, the path is not a folder,
// and, if the model gave the name, it is not a file that lambent did not write. Unless the user named the file, the
// folder may be missing (-o pictures/), if it can be made.
bool output_check(const char *path, const char *model, enum output_given given, lam_error *error);

// Returns true if the picture is written directly to `path` as a PNG: "-", or a pipe or device without a picture's
// extension.
bool output_is_stream(const char *path);

// Returns the ending of the format that is written to `path`, as "jpg": "png" of a stream and of a name without an
// ending.
const char *output_ending(const char *path);

// The pixels of that format; bytes for a stream. Error: LAM_UNSUPPORTED.
bool output_format(const char *path, lam_pixel_format *format, lam_error *error);

// Checks that the file's format stores 8 bits per number. Errors: as output_format, and "PATH: a sheet is written as
// .svg, .png or .jpg" with the noun "sheet" and the extensions `others` (".svg, " or ""), which the command writes
// itself.
bool output_check_bytes(const char *path, const char *noun, const char *others, lam_error *error);

// Returns true if the name ends like a file of a model format. Scene files (.json) do not count: most JSON files are
// not one.
bool is_model_name(const char *name);

// Writes a picture to a file, whose missing folder is made, or to a stream. `size` receives the bytes written, 0 for a
// file that is not regular.
bool output_save(const lam_image *image, const char *path, const lam_save_params *params, uint64_t *size,
                 lam_error *error);

// Shows each picture that output_save writes, as a PNG and as pixels (LAM_RGBA8); pictures for "-" are shown and not
// written. NULL: none is shown.
typedef bool output_show_fn(const lam_bytes *png, const lam_image *image, lam_error *error);
void output_show_with(output_show_fn *show);

// The same for encoded bytes; `durable` as in lam_save_params.
bool output_save_bytes(const lam_bytes *bytes, const char *path, bool durable, uint64_t *size, lam_error *error);

// Returns the size of the file at `path` in bytes; 0 if it is not a file.
uint64_t output_size(const char *path);
#endif
