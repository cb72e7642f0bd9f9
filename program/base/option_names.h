// option_names.h: replaces field names in the library's messages with the options that set these fields.
#ifndef OPTION_NAMES_H
#define OPTION_NAMES_H

enum { MESSAGE_SIZE = 1024 };

// Copies a message of the library and replaces its field names with options: "(lam_control.pixel_limit)" becomes
// "(--pixel-limit)". Returns `out`.
const char *name_options(const char *text, char out[MESSAGE_SIZE]);

#endif
