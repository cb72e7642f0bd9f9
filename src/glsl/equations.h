// equations.h: a stage's text from the equations of src/lighting and the *.glsl files of this folder.
#ifndef EQUATIONS_H
#define EQUATIONS_H

#include "specialize.h"

// A part of a stage: definitions in the order of their calls, with their comments.
struct stage_source {
    const char *title; // over the definitions that are called; NULL: none
    const char *text;  // NULL: nothing
    bool made;         // the text is made for this stage: it is printed as it is
    bool whole;        // its functions keep parameters and variables that they do not read
};

// Appends the definitions that the function `main` needs, directly or indirectly: those of the equations, then those of the
// sources. Words of the dialect become GLSL: num float, mask bool, STRUCT struct; FN disappears. Branches with a known
// condition are resolved. What is then never read is removed (specialize.h).
void equations_add(struct text *text, const struct stage_source *sources, int count, const struct known *known);

#endif
