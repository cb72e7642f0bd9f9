// preprocess.h: the words of a GLSL source after preprocessing: macros are expanded, and excluded branches are removed.
#ifndef PREPROCESS_H
#define PREPROCESS_H

#include "declarations.h"

// Stores the words of the source, and the version in its #version line, in `d`. Invalid sources are accepted: unknown
// parts are kept unchanged, and a source that expands to more than half a million words is truncated. Returns false if
// memory runs out.
bool preprocess(struct declarations *d, const char *text);

#endif
