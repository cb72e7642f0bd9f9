// prefix.h: completes shader sources as an engine does before it compiles them (ShaderMaterial of three.js).
#ifndef PREFIX_H
#define PREFIX_H

#include "contract.h"
#include "declarations.h"

#include <lambent/base.h>

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

// --- makes the sources that a check uses: normalises line endings, and declares the fixed-function state of GLSL 110
// and 120 as inputs.

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

// --- finds the contract whose names a program uses.

// Finds the contract that matches the names in the shaders best. *out is NULL if no contract contains any of them.
// Returns false on failure (LAM_LIMIT).
bool contract_recognise(lam_check_contract *const *contracts, int count, struct program_texts *texts,
                        const struct contract **out, lam_error *error);

// --- makes a contract from the roles that a reading found (reading.h).

struct inferred_role {
    const char *name, *role, *space; // of the contract; `space` may be NULL
};

// Returns the text of a contract that allows any strengths, allocated with malloc. Numbers get their roles from the
// words in their names, and other inputs without a known role are free. `engine` is the contract whose prefix the
// sources lack, or NULL. `reason` (may be "") names the first matrix without a role.
char *contract_infer(const struct declarations *vertex, const struct declarations *fragment,
                     const struct contract *engine, const struct inferred_role *known, int count, const char *space,
                     char *reason, size_t capacity);

#endif
