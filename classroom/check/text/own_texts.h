// own_texts.h: makes the sources that a check uses: normalises line endings, and declares the fixed-function state of
// GLSL 110 and 120 as inputs.
#ifndef OWN_TEXTS_H
#define OWN_TEXTS_H

#include <lambent/base.h>

struct own_texts {
    const char *vertex, *fragment; // the given source, or one of the copies below; may be NULL
    char *lines[2], *rewritten[2]; // allocated with malloc; NULL if not needed
};

// Makes the sources for the check from the given sources, which must outlive the result. Returns false on failure:
// LAM_LIMIT. The caller frees the sources in any case.
bool own_texts_make(const char *vertex, const char *fragment, struct own_texts *out, lam_error *error);
void own_texts_free(struct own_texts *texts);

#endif
