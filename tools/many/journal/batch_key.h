// batch_key.h: everything that determines a picture: the options with their defaults, the program's version, the
// contents of files.
#ifndef BATCH_KEY_H
#define BATCH_KEY_H

#include "options.h"

// Returns the options that determine a picture, one `name=value` per line, given or by default, without side and size;
// files that they name appear with their hash. From malloc; NULL: see `error` (LAM_CANNOT_READ: such a file).
char *batch_options_text(const struct options *options, lam_error *error);

// Returns the options of the command line that change the picture, as they are typed: "--size 256 --light 'eye=1/2/3'".
// Relative paths stay as they are. From malloc, or NULL if memory runs out.
char *batch_options_given(const struct options *options);

// The options of both texts that differ first, as "--size 512 … --size 256": for a sentence. The texts differ.
void batch_options_difference(const char *then, const char *now, char text[300]);

// The inputs of one picture's key.
struct batch_key_parts {
    const char *options;          // batch_options_text
    const struct options *parsed; // the same, for scene files: which options were given
    const char *model;            // used if no file was read: a built-in shape
    const char *format;           // of the model: lam_scene_format
    const char *picture;          // the ending of the picture's name
    int side, width, height;
    const char *const *files; // hashes of the files, or "absent"
    int file_count;
};
uint64_t batch_key(const struct batch_key_parts *parts);

#endif
