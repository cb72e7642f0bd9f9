// declarations.h: the declarations of a GLSL source: uniforms, attributes, varyings.
//
// The declarations are parsed from the source, not queried from the compiled program. The check also needs names and
// lines for shaders that do not compile, and for uniforms that the compiler removes. preprocess.c splits the source
// into words.
#ifndef DECLARATIONS_H
#define DECLARATIONS_H

#include <ctype.h>
#include <lambent/base.h>

#include "text_builder.h"

enum declared { DECLARED_UNIFORM, DECLARED_INPUT, DECLARED_OUTPUT };

// A declared name. Each member of a uniform struct has its own entry: "lights[].position".
struct declaration {
    enum declared kind;
    char type[32];
    char name[96];
    int count; // the size of the outermost array; 0 if the name is not an array, −1 if the size is not a literal number
    int line;
    bool flat;     // whether the interpolation qualifier is `flat`
    bool in_block; // member of an interface block
};

struct word {
    char text[64]; // an identifier, a number, or one punctuation character
    int line;
    int depth;       // nesting of braces
    bool is_member;  // follows a '.'
    char number[24]; // of the name of a macro that is a number, which is not expanded; otherwise ""
    // Used by declarations_uses. The first entry of each distinct word stores two counts: the word's occurrences,
    // and its occurrences as a declared name.
    int times, declared;
    int constant; // likewise for the first entry: the index of the number after `int NAME =`, or 0
};

enum { MAX_WORDS = 1 << 18, MAX_DECLARATIONS = 1 << 16 };

struct declarations {
    int version;      // the value of #version, or 0
    char profile[16]; // "core", "compatibility", "es", or ""
    bool cut;         // the source has more than MAX_WORDS or MAX_DECLARATIONS, and the rest was ignored
    struct declaration *items;
    int count;
    struct word *words; // the tokens of the whole source (preprocess.c)
    int word_count;
    int *slots;     // a hash table that stores 1 + the index of the first equal word, or 0 if empty
    int slot_count; // a power of 2
};

// Parses a shader's source. Varyings are outputs of a vertex shader (`vertex`) and inputs of a fragment shader. Returns
// false if memory runs out.
bool declarations_read(struct declarations *d, const char *text, bool vertex, lam_error *error);
void declarations_free(struct declarations *d);

// Write and read declarations as bytes, for another process of the same program. declarations_unpack advances *at, and
// returns false if the bytes are invalid or memory runs out. The caller frees `d` in any case.
void declarations_pack(const struct declarations *d, struct text *out);
bool declarations_unpack(struct declarations *d, const char **at, const char *end);

// Returns whether an identifier occurs outside its own declaration.
bool declarations_uses(const struct declarations *d, const char *name);

// Returns how many elements of an array two stages read, if all indices are constants. Otherwise, returns `count`.
int declarations_read_elements(const struct declarations *vertex, const struct declarations *fragment, const char *name,
                               int count);

const struct declaration *declarations_find(const struct declarations *d, enum declared kind, const char *name);

// Returns whether word `i` exists and is equal to `text`.
bool word_is(const struct declarations *d, int i, const char *text);

// Parses the number at word *at, which may begin with a minus sign, and advances *at past the number. Returns false if
// there is none.
bool word_take_number(const struct declarations *d, int *at, double *out);

// Returns a hash of a word (FNV-1a).
static inline uint32_t word_hash(const char *text)
{
    uint32_t hash = 2166136261u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 16777619u;
    return hash;
}

// Returns whether a word is an identifier or a keyword.
static inline bool word_is_name(const char *text) { return isalpha((unsigned char)text[0]) || text[0] == '_'; }

// --- the words of a GLSL source after preprocessing: macros are expanded, and excluded branches are removed.

// Stores the words of the source, and the version in its #version line, in `d`. Invalid sources are accepted: unknown
// parts are kept unchanged. The time is proportional to the length of the text, and limited: if the source or the
// expansion of its macros is too long, sets `d->cut` and ignores the rest. Returns false if memory runs out.
bool preprocess(struct declarations *d, const char *text);

#endif
