// own_texts.h: makes the source texts that a check uses: normalises line ends, and declares the fixed state of GLSL 110
// and 120 as inputs.
#ifndef OWN_TEXTS_H
#define OWN_TEXTS_H

#include <lambent/base.h>

struct own_texts {
    const char *vertex, *fragment; // the given text, or one of the copies below; may be NULL
    char *lines[2], *rewritten[2]; // allocated with malloc; NULL if not needed
};

// Makes the texts from the source texts of a program, which must outlive them. Returns false on failure: LAM_LIMIT. The
// caller frees them in any case.
bool own_texts_make(const char *vertex, const char *fragment, struct own_texts *out, lam_error *error);
void own_texts_free(struct own_texts *texts);

#endif
