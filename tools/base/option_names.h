// option_names.h: names of the library's fields in its sentences, replaced by the options that set them.
#ifndef OPTION_NAMES_H
#define OPTION_NAMES_H

enum { MESSAGE_SIZE = 1024 };

// Copies a sentence of the library with options in place of its fields: "(lam_control.pixel_limit)" becomes "(--pixel-limit)". Returns `out`.
const char *name_options(const char *text, char out[MESSAGE_SIZE]);

#endif
