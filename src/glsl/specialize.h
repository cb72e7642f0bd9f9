// specialize.h: takes out of the equations' text what a choice has decided, so that a reader of a printed
// shader finds no branch that is never taken and no number that nobody looks at.
//
// It knows the shape that the formatter gives src/lighting, no more of C than that: an `if` with its brace
// ends its line, and its closing brace stands under it.
#ifndef SPECIALIZE_H
#define SPECIALIZE_H

#include "shader_preprocess.h"

// The condition of an `if`, as it stands between the brackets. A table ends with NULL.
struct decided {
    const char *condition;
    bool holds;
};

// Appends a text in which each `if` that is decided is replaced by what follows from it.
void simplify_conditions(struct text *text, const char *source, const struct decided *decided);

// A stretch of text: the definition of a function or struct of src/lighting, or code that uses them.
struct stretch {
    char *start, *end;
};

// Members of structs (STRUCT(name), one member a line) that no stretch reads go, and with them the lines that
// only give them a value. What goes is overwritten with SIMPLIFY_GONE. Returns whether anything went; what
// was needed for that alone may then go in another round.
enum { SIMPLIFY_GONE = 1 };
bool simplify_members(const struct stretch *stretches, int count);

#endif
