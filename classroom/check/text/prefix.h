// prefix.h: texts that an engine completes before it compiles them (three.js' ShaderMaterial).
#ifndef PREFIX_H
#define PREFIX_H

#include "contract.h"

// The texts of a program as the contract's engine compiles them.
struct complete_texts {
    const char *vertex, *fragment; // `vertex` NULL: none is given
    char *owned[2];                // the author's
    int lines[2];                  // the prefix of the texts: this many lines
};

// Whether a contract's engine completes texts with these declarations: they have no version line and declare none of the
// names that its prefix declares. `vertex` may be NULL. False: out of memory.
bool prefix_applies(const struct contract *contract, const struct declarations *vertex,
                    const struct declarations *fragment, bool *applies, lam_error *error);

// Adds the prefix. False: out of memory. The caller frees `out`.
bool prefix_add(const struct contract *contract, const char *vertex, const char *fragment, struct complete_texts *out,
                lam_error *error);

// Completes the texts of a program for a contract: its prefix is added if it applies; otherwise they do not change.
// `vertex` may be NULL. False: out of memory. The caller frees `out`.
bool prefix_complete(const struct contract *contract, const char *vertex, const char *fragment,
                     struct complete_texts *out, lam_error *error);
void prefix_free(struct complete_texts *texts);

// Reads the declarations of such a text, with the lines of the text itself; declarations of the prefix have line 0.
bool prefix_read(const struct complete_texts *texts, bool vertex, struct declarations *out, lam_error *error);

#endif
