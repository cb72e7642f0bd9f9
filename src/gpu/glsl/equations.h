// equations.h: composes the source of a shader stage from the equations in src/core/lighting and the files in src/gpu/glsl/text.
#ifndef EQUATIONS_H
#define EQUATIONS_H

#include "specialize.h"

// A section of a shader stage: definitions in the order of their calls, with their comments.
struct stage_source {
    const char *title; // heading of the called definitions, or NULL
    const char *text;  // may be NULL
    bool made;         // the source is generated for this stage and printed unchanged
    bool whole;        // keeps unread parameters and variables of the functions
};

// Appends the definitions that the function `main` needs, directly or indirectly: first from the equations, then from
// the sources. If the condition of a branch is known, the branch is resolved; names that become unused are removed
// (specialize.h). embed.py has translated the dialect of the equations to GLSL.
void equations_add(struct text *text, const struct stage_source *sources, int count, const struct known *known);

#endif
