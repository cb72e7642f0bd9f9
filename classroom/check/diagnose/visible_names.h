// visible_names.h: the names that are declared and in scope at a place of a shader.
#ifndef VISIBLE_NAMES_H
#define VISIBLE_NAMES_H

#include "declarations.h"

enum { MAX_VISIBLE_NAMES = 256 };

struct visible_names {
    // The innermost scopes' last. If there are more than fit, the innermost are kept.
    const char *names[MAX_VISIBLE_NAMES];
    int depths[MAX_VISIBLE_NAMES]; // of braces; 0: global
    int count;
};

// The names of variables (`functions`: of the shader's own functions) that the statement of word `at` can use: its own
// declaration does not count, for it begins only after the statement.
void visible_names_at(const struct declarations *d, int at, bool functions, struct visible_names *out);

#endif
