// glsl_text.h: reduces general sources to the shader for one set of choices. This module removes branches that are
// never taken, and the parameters, variables and members that are then unread.
//
// The source must have the layout that clang-format gives to src/core/lighting. An `if` ends its line with the opening
// brace, and the closing brace is in the same column as the `if`. A condition or a choice (?:) of known names is on one
// line.
#ifndef GLSL_TEXT_H
#define GLSL_TEXT_H

#include "text_builder.h"

// A row of the table: a name, or the condition of an `if` as written between the parentheses, and its replacement. The
// replacements "true" and "false" decide branches. A line "NAME;" is replaced by the lines of the replacement. A table
// ends with NULL.
struct constant {
    const char *name, *text;
};

// Appends `source`, without the branches that the table excludes.
void specialize_branches(struct text *text, const char *source, const struct constant *constants);

// The definition of a function or struct, and the comment before it.
struct source_span {
    char *lead, *start, *end;
    bool reduced; // unread parameters and variables are removed too
};

// Overwrites unread text with SPECIALIZE_ERASED: members of structs (one member per line) that no span reads, and the
// lines that only set these members. In reduced functions, also overwrites unread variables and unread parameters. For
// an unread parameter, overwrites the arguments in all calls, and the lines of the comment that begin with the
// parameter's name ("// `NAME`"). Returns whether anything was erased; another call may then erase more.
enum { SPECIALIZE_ERASED = 1 };
bool specialize_unread(const struct source_span *spans, int count);

// Composes the source of a shader stage from the equations in src/core/lighting and the files in src/gpu/glsl/text.

// A section of a shader stage: definitions in the order of their calls, with their comments.
struct stage_source {
    const char *title; // heading of the called definitions, or NULL
    const char *text;  // may be NULL
    bool made;         // the source is generated for this stage and printed unchanged
    bool whole;        // keeps unread parameters and variables of the functions
};

// Appends the definitions that the function `main` needs, directly or indirectly: first from the equations, then from
// the sources. If the condition of a branch is known, the branch is resolved; names that become unused are removed
// (specialize_unread). embed.py has translated the dialect of the equations to GLSL.
void equations_add(struct text *text, const struct stage_source *sources, int count, const struct constant *constants);

#endif
