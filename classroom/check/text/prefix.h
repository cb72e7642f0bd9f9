// prefix.h: completes shader sources as an engine does before it compiles them (ShaderMaterial of three.js).
#ifndef PREFIX_H
#define PREFIX_H

#include "contract.h"

// The shader sources of a program as the contract's engine compiles them.
struct complete_texts {
    const char *vertex, *fragment; // `vertex` is NULL if it is not given
    char *owned[2];                // the allocated copies
    int lines[2];                  // the number of lines in the prefixes
};

// Determines whether a contract's engine completes sources with these declarations. The engine completes sources
// without a version line that declare none of the names in the engine's prefix. `vertex` may be NULL. Returns false if
// memory runs out.
bool prefix_applies(const struct contract *contract, const struct declarations *vertex,
                    const struct declarations *fragment, bool *applies, lam_error *error);

// Adds the prefix. Returns false if memory runs out. The caller frees `out`.
bool prefix_add(const struct contract *contract, const char *vertex, const char *fragment, struct complete_texts *out,
                lam_error *error);

// Completes the shader sources of a program for a contract: adds the contract's prefix if the prefix applies, and
// otherwise leaves the sources unchanged.
// `vertex` may be NULL. Returns false if memory runs out. The caller frees `out`.
bool prefix_complete(const struct contract *contract, const char *vertex, const char *fragment,
                     struct complete_texts *out, lam_error *error);
void prefix_free(struct complete_texts *texts);

// Parses the declarations of a completed source. Lines are counted without the prefix, and declarations in the prefix
// have line 0.
bool prefix_read(const struct complete_texts *texts, bool vertex, struct declarations *out, lam_error *error);

#endif
