// specialize.h: removes from the equations' text the branches that a choice never takes and the members that are never
// read, so that a printed shader has neither.
//
// The text must have the layout that the formatter gives src/lighting: an `if` ends its line with the opening brace, and
// the closing brace is in the same column as the `if`.
#ifndef SPECIALIZE_H
#define SPECIALIZE_H

#include "shader_preprocess.h"

// The condition of an `if`, as written between the parentheses, and its value. A table ends with NULL.
struct known_condition {
    const char *condition;
    bool holds;
};

// Appends `source`, with each `if` whose condition is known replaced by the branch taken.
void specialize_conditions(struct text *text, const char *source, const struct known_condition *known);

// The definition of a function or struct of src/lighting, or code that uses them.
struct source_span {
    char *start, *end;
};

// Overwrites with SPECIALIZE_ERASED the members of structs (STRUCT(name), one member a line) that no span reads, and the
// lines that only set them. Returns whether any was erased; another call may then erase more.
enum { SPECIALIZE_ERASED = 1 };
bool specialize_members(const struct source_span *spans, int count);

#endif
