// specialize.h: reduces ordinary texts to the shader of some choices: branches that a choice never takes go, and the parameters,
// variables and members that are then never read, so that a printed shader has none of them.
//
// The text must have the layout that the formatter gives src/lighting: an `if` ends its line with the opening brace, the
// closing brace is in the same column as the `if`, and a condition or a choice (?:) of known names is on one line.
#ifndef SPECIALIZE_H
#define SPECIALIZE_H

#include "text_builder.h"

// A name, or the condition of an `if` as written between the parentheses, and its text. "true" and "false" decide branches; other
// texts replace the name; as a line of its own ("NAME;"), the lines of the text do. A table ends with NULL.
struct known {
    const char *name, *text;
};

// Appends `source` without what the table decides.
void specialize_branches(struct text *text, const char *source, const struct known *known);

// The definition of a function or struct, and the comment before it.
struct source_span {
    char *lead, *start, *end;
    bool reduced; // parameters and variables that it does not read go, too
};

// Overwrites with SPECIALIZE_ERASED the members of structs (STRUCT(name), one member a line) that no span reads, and the
// lines that only set them; and in reduced functions unread parameters, the arguments for them and the lines of the comment that
// begin with their names ("// `NAME`"), and unread variables. Returns
// whether anything was erased; another call may then erase more.
enum { SPECIALIZE_ERASED = 1 };
bool specialize_unread(const struct source_span *spans, int count);

#endif
