// preprocess.h: the words of a GLSL source after preprocessing: macros are expanded, and excluded branches are removed.
#ifndef PREPROCESS_H
#define PREPROCESS_H

#include "declarations.h"

// Stores the words of the source, and the version in its #version line, in `d`. Invalid sources are accepted: unknown
// parts are kept unchanged. The time is proportional to the length of the text, and limited: if the source or the
// expansion of its macros is too long, sets `d->cut` and ignores the rest. Returns false if memory runs out.
bool preprocess(struct declarations *d, const char *text);

#endif
