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

// --- the lights and materials of OpenGL's fixed-function state, which GLSL 110 and 120 can read.

// Rewrites a shader so that it reads uniforms such as fixed_LightSource[i].position, instead of gl_LightSource,
// gl_FrontMaterial and similar state. A program can set these uniforms. `other` is the source of the other stage and
// may be NULL. The result is allocated with malloc. Returns NULL if the shader reads no fixed-function state. Also
// returns NULL, and sets *ok to false, if memory runs out.
char *fixed_state_rewrite(const char *text, const char *other, bool *ok);

// Returns whether a name is part of the fixed-function state, or of a struct in this state: gl_LightSource[].position.
bool fixed_state_has(const char *name);

#endif
