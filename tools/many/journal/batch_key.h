// batch_key.h: everything that determines a picture: the options with their defaults, the program's version, the
// contents of files.
#ifndef BATCH_KEY_H
#define BATCH_KEY_H

#include "options.h"

// Returns the options that determine a picture, one `name=value` per line, including defaults, without side and size;
// files that they name are listed with their hash. From malloc; returns NULL and fills `error` on failure
// (LAM_CANNOT_READ: such a file).
char *batch_options_text(const struct options *options, lam_error *error);

// Returns the options of the command line that affect the picture, as typed: "--size 256 --light 'eye=1/2/3'". Relative
// paths are unchanged. From malloc; NULL if memory runs out.
char *batch_options_given(const struct options *options);

// Formats the first different options of two different texts, as "--size 512 … --size 256", for a sentence.
void batch_options_difference(const char *then, const char *now, char text[300]);

// The inputs of one picture's key.
struct batch_key_parts {
    const char *options;          // batch_options_text
    const struct options *parsed; // same as above, to know the given options for scene files
    const char *model;            // used if no file was read: a built-in shape
    const char *format;           // the model's format: lam_scene_format
    const char *picture;          // the extension of the picture's name
    int side, width, height;
    const char *const *files; // hashes of the files, or "absent"
    int file_count;
};
uint64_t batch_key(const struct batch_key_parts *parts);

#endif
