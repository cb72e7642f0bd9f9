// batch_key.h: computes the hash of everything that determines a picture: the options with their defaults, the
// program's version and the contents of files.
#ifndef BATCH_KEY_H
#define BATCH_KEY_H

#include "options.h"

// Returns the options that determine a picture, allocated with malloc: one `name=value` per line, including defaults,
// but without side and size. If an option names files, the text contains the files' hashes. Returns NULL on failure;
// LAM_CANNOT_READ means that a file named by an option cannot be read.
char *batch_options_text(const struct options *options, lam_error *error);

// Returns the options of the command line that affect the picture, as typed: "--size 256 --light 'eye=1/2/3'". Relative
// paths are unchanged. The text is allocated with malloc. Returns NULL if memory runs out.
char *batch_options_given(const struct options *options);

// Formats the first options that differ between two texts, as "--size 512 … --size 256", for use in a message.
void batch_options_difference(const char *then, const char *now, char text[300]);

// The inputs of one picture's key.
struct batch_key_parts {
    const char *options; // batch_options_text
    // The same options, parsed; for a scene file, the key includes the names of the typed options.
    const struct options *parsed;
    const char *model;   // the name of a built-in shape; used if no file was read
    const char *format;  // the model's format: lam_scene_format
    const char *picture; // the extension of the picture's name
    int side, width, height;
    const char *const *files; // hashes of the files, or "absent"
    int file_count;
};
uint64_t batch_key(const struct batch_key_parts *parts);

#endif
