// look_option.h: --look: built-in and users' files of options.
#ifndef LOOK_OPTION_H
#define LOOK_OPTION_H

#include "options.h"

// Returns the looks that are built in, from 0: the name, and the file. Returns NULL if the index is out of range.
const char *look_name(int look);
const char *look_text(int look);

// Returns a look that is built in by its name, or NULL if there is none.
const char *look_find(const char *name);

// Writes the purpose of a look, the first line of its file, to `out`.
void look_summary(const char *text, char *out, size_t size);

// Calls `take` for each option of a look, a built-in one or a file, until it returns false. It passes the line's
// number, the name without dashes and the value ("" without one), which live as long as *kept. The caller frees *kept,
// also after a failure. Fails with LAM_BAD_ARGUMENT.
bool look_read(const char *name, char **kept,
               bool (*take)(void *user, int line, char *option, char *value, lam_error *error), void *user,
               lam_error *error);

#endif
