// shown_name.h: names from files, as messages show them.
#ifndef SHOWN_NAME_H
#define SHOWN_NAME_H

#include <stddef.h>

enum {
    SHOWN_CHARACTERS = 32,                      // of a name; the rest becomes "…"
    SHOWN_NAME_SIZE = 4 * SHOWN_CHARACTERS + 4, // bytes, with the "…" and the final 0
};

// Writes a name from a file to `out`, for a message: its first SHOWN_CHARACTERS characters, and "…" if it has more.
// Control characters and bytes that are not UTF-8 become '?', so that a file cannot send control sequences to a
// terminal. Returns `out`.
const char *shown_name(const char *name, char out[SHOWN_NAME_SIZE]);
const char *shown_name_of(const void *bytes, size_t length, char out[SHOWN_NAME_SIZE]); // not ended by a 0

#endif
