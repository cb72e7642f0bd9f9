// equations.h: the equations as plain GLSL: what a text calls of them, with their comments.
#ifndef EQUATIONS_H
#define EQUATIONS_H

#include "specialize.h"

// Appends those of the words and equations that `calls`, a GLSL text, calls, directly or through others, in
// their order. The words of the dialect become GLSL's own: num float, mask bool, FN and STRUCT nothing and
// struct. What is decided, and what nobody then reads, is left out; lines of `calls` that only set such a
// member are taken out of it.
void equations_add(struct text *text, char *calls, const struct decided *decided);

#endif
