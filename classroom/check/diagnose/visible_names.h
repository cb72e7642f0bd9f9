// visible_names.h: finds the names that are declared and in scope at a position in a shader.
#ifndef VISIBLE_NAMES_H
#define VISIBLE_NAMES_H

#include "declarations.h"

enum { MAX_VISIBLE_NAMES = 256 };

struct visible_names {
    // Names of inner scopes follow names of outer scopes. If there are too many names, the innermost names are kept.
    const char *names[MAX_VISIBLE_NAMES];
    int depths[MAX_VISIBLE_NAMES]; // the nesting depth of braces; 0 is global
    int count;
};

// Finds the names of the variables that the statement at word `at` can use. With `functions`, finds the names of the
// shader's own functions instead. A variable that the statement declares is not included, because its scope begins
// after the statement.
void visible_names_at(const struct declarations *d, int at, bool functions, struct visible_names *out);

#endif
