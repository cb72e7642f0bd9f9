// prefix.h: completes shader sources as an engine does before it compiles them (ShaderMaterial of three.js).
#ifndef PREFIX_H
#define PREFIX_H

#include "contract.h"
#include "declarations.h"

// The shader sources of a program as a compiler receives them, and their declarations.
struct complete_texts {
    const char *vertex, *fragment; // `vertex` is NULL if it is not given
    char *owned[2];                // the allocated copies
    int lines[2];                  // the number of lines in the prefixes
    // Of the vertex and the fragment shader. Lines are counted without the prefix, and declarations in the prefix have
    // line 0.
    struct declarations sides[2];
};
void prefix_free(struct complete_texts *texts);

// Parses the declarations of both sources. Fails with LAM_LIMIT. `user` is for other functions of this type.
typedef bool prefix_reader(void *user, struct complete_texts *texts, lam_error *error);
prefix_reader prefix_read;

// The sources of a program as submitted and read, and as an engine completes them. Each is read once, for all contracts.
struct program_texts {
    struct complete_texts own, completed; // `completed.fragment` is NULL until prefix_texts needs it
    prefix_reader *read;
    void *user; // passed to `read`
};

// Returns the sources that a contract's engine compiles. The engine adds its prefix to sources without a version line
// that declare none of the names in the prefix. The result is valid until the next call for a contract with another
// prefix. Returns NULL on failure.
const struct complete_texts *prefix_texts(struct program_texts *texts, const struct contract *contract,
                                          lam_error *error);

#endif
