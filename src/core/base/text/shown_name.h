// shown_name.h: shortens names from files for messages.
#ifndef SHOWN_NAME_H
#define SHOWN_NAME_H

#include <stddef.h>

enum {
    SHOWN_CHARACTERS = 32,                      // characters of a name; the rest becomes "…"
    SHOWN_NAME_SIZE = 4 * SHOWN_CHARACTERS + 4, // bytes, including the "…" and the final 0
};

// Writes the name of a file like shown_name. In a longer name, "…" replaces the middle instead of the end. The first
// SHOWN_FILE_HEAD characters precede the "…". Returns `out`.
enum { SHOWN_FILE_HEAD = 12 };
const char *shown_file(const char *name, char out[SHOWN_NAME_SIZE]);

// Writes a name from a file to `out` for a message: its first SHOWN_CHARACTERS characters, and "…" if it is longer.
// Control characters and invalid UTF-8 become '?', so that a file cannot send control sequences to a terminal. Returns
// `out`.
const char *shown_name(const char *name, char out[SHOWN_NAME_SIZE]);
const char *shown_name_of(const void *bytes, size_t length, char out[SHOWN_NAME_SIZE]); // not terminated by 0

#endif
