// look_option.h: reads built-in and user-defined looks for --look.
#ifndef LOOK_OPTION_H
#define LOOK_OPTION_H

#include "options.h"

// Return the name and the text of the built-in look with this index, counted from 0, or NULL if the index is out of
// range.
const char *look_name(int look);
const char *look_text(int look);

// Returns the text of the built-in look with this name, or NULL if there is no such look.
const char *look_find(const char *name);

// Writes a look's summary (the first line of the file) to `out`.
void look_summary(const char *text, char *out, size_t size);

// Calls `take` for each option of a built-in look or a look file until `take` returns false. Passes the line number,
// the option's name without dashes and its value ("" for an option without a value). These strings are valid until the
// caller frees *kept. The caller must free *kept even after a failure. Fails with LAM_BAD_ARGUMENT.
bool look_read(const char *name, char **kept,
               bool (*take)(void *user, int line, char *option, char *value, lam_error *error), void *user,
               lam_error *error);

#endif
