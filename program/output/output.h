// output.h: determines the path of a picture, checks it and writes the picture.
#ifndef OUTPUT_H
#define OUTPUT_H

#include "file_io.h"
#include "output_name.h"

#include <lambent/image.h>

// Returns true if --output names a file, and false if `output` is NULL (not given) or a folder ("thumbs/").
bool output_is_named(const char *output);

// Returns the path of a picture, allocated with malloc. If `output` names a file, the path is `output`. Otherwise the
// path is the model's name with `ending`, in the folder `output` or in the current folder. For example, the name for
// "dir/koala.obj" is "koala.png" with the ending ".png", and "koala-terms.png" with the ending "-terms.png". The name
// for "-" is "model.png". Returns NULL if memory runs out.
char *output_path(const char *output, const char *model, const char *ending);

// Returns the path of a model's picture, allocated with malloc: the expanded pattern, or the result of output_path.
// Returns NULL if memory runs out.
char *output_path_of(const char *output, const struct output_words *words);

// The source of a picture's name: the model's name (in the current or a given folder), the user's name, or the user's
// pattern. The result of output_is_named can be used as one of the first two constants.
enum output_given { OUTPUT_BY_MODEL, OUTPUT_NAMED, OUTPUT_PATTERN };
enum output_given output_given(const char *output);

// Checks before the work starts that `path` can be written: its folder exists and is writable, and the path is not a
// folder. If the name comes from the model, an existing file must have been written by Lambent. If --output names only
// a folder (-o pictures/), the folder need not exist yet, but the program must be able to create it.
bool output_check(const char *path, const char *model, enum output_given given, lam_error *error);

// Returns true if the picture is written directly to `path` as a PNG: "-", or a pipe or device without the extension of
// a picture format.
bool output_is_stream(const char *path);

// Returns the extension of the format written to `path`, such as "jpg"; "png" for a stream or a name without an
// extension.
const char *output_ending(const char *path);

// Sets `format` to the pixel format that suits the extension of `path`; a stream has 8 bits per channel. Fails with
// LAM_UNSUPPORTED.
bool output_format(const char *path, lam_pixel_format *format, lam_error *error);

// Checks that the file format stores 8 bits per channel. Fails like output_format, or with an error such as "PATH: a
// sheet is written as .svg, .png or .jpg". In this error, `noun` is "sheet" and `others` is ".svg, ": the extensions
// that the command writes itself, or "".
bool output_check_bytes(const char *path, const char *noun, const char *others, lam_error *error);

// Returns true if the name has the extension of a model format. Returns false for every .json file, even a scene file,
// because most JSON files are not scenes.
bool is_model_name(const char *name);

// Writes a picture to a file or a stream. Creates the folder of the file if it is missing. Sets `size` to the number of
// bytes, or to 0 if the file is not regular.
bool output_save(const lam_image *image, const char *path, const lam_save_params *params, uint64_t *size,
                 lam_error *error);

// A callback for each picture that output_save writes. The callback receives the picture as a PNG and as pixels
// (LAM_RGBA8). If a callback is set, pictures for "-" are passed to the callback and not written. NULL removes the
// callback.
typedef bool output_show_fn(const lam_bytes *png, const lam_image *image, lam_error *error);
void output_show_with(output_show_fn *show);

// Writes encoded bytes like output_save, but without the callback. `durable` is as in lam_save_params.
bool output_save_bytes(const lam_bytes *bytes, const char *path, bool durable, uint64_t *size, lam_error *error);

// Returns the size in bytes of the file at `path`, or 0 if `path` is not a file.
uint64_t output_size(const char *path);

// --- reduces large pictures.

// Makes a reduced picture (LAM_RGBA8) whose longer side has at most `most` pixels. `from` is linear and premultiplied
// (LAM_RGBA32F, lam_image_load_linear). The result is never larger than `from`. The caller frees the result. Fails with
// LAM_LIMIT.
bool shrink_linear(const lam_image *from, int most, lam_image *to, lam_error *error);

// Like shrink_linear, but for a picture in LAM_RGBA8 without padding, encoded in sRGB. Copies a picture that already
// fits.
bool shrink_bytes(const lam_image *from, int most, lam_image *to, lam_error *error);

#endif
