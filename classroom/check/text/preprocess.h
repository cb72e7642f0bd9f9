// preprocess.h: the words of a GLSL text after preprocessing: macros are expanded, and excluded branches are removed.
#ifndef PREPROCESS_H
#define PREPROCESS_H

#include "declarations.h"

// Stores the words of the text, and the version of its #version line, in `d`. Invalid texts are accepted: unknown parts
// are kept unchanged, and a text that expands to more than half a million words is truncated. Returns false if memory
// runs out.
bool preprocess(struct declarations *d, const char *text);

#endif
