// preprocess.h: the words of a GLSL text as the preprocessor leaves them: macros are expanded, excluded branches left out.
#ifndef PREPROCESS_H
#define PREPROCESS_H

#include "declarations.h"

// Stores the words of the text, and the version of its #version line, in `d`. Never fails for a wrong text: unknown
// parts do not change, and a text that expands to more than half a million words ends there. False: out of memory.
bool preprocess(struct declarations *d, const char *text);

#endif
