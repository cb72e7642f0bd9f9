// declarations.h: what a GLSL source declares, found by reading its text: uniforms, attributes, varyings.
//
// The text is read, not the compiled program, because names and lines are wanted of shaders that do not
// compile, and of uniforms that a compiler drops. Comments and preprocessor lines are skipped; code that the
// preprocessor would drop is read too.
#ifndef DECLARATIONS_H
#define DECLARATIONS_H

#include <lambent/base.h>

enum declared { DECLARED_UNIFORM, DECLARED_INPUT, DECLARED_OUTPUT };

// A member of a struct that is a uniform stands by itself: "lights[].position". Types and names are pieces of `names`.
struct declaration {
    enum declared kind;
    char type[32];
    char name[96];
    int count; // of the outermost array; 0: none, −1: its size is not a number that the text tells
    int line;
    bool flat;     // interpolation qualifier
    bool in_block; // of a block
    bool varying;  // while it is read: of which kind is not known yet
};

struct word {
    char text[64]; // an identifier, a number, or one sign
    int line;
    int depth;         // of braces
    bool after_member; // stands behind a '.'
};

struct declarations {
    int version;      // of #version; 0: none
    char profile[16]; // "core", "compatibility", "es", or ""
    struct declaration *items;
    int count;
    struct word *words; // of the whole text
    int word_count;
};

// False: memory is out.
bool declarations_read(struct declarations *d, const char *text, lam_error *error);
void declarations_free(struct declarations *d);

// Whether an identifier stands anywhere; behind its declaration, where it is declared.
bool declarations_use(const struct declarations *d, const char *name);

const struct declaration *declarations_find(const struct declarations *d, enum declared kind, const char *name);

#endif
