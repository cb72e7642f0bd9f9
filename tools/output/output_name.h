// output_name.h: names of pictures made from a pattern: 'thumbs/{dir}/{stem}-{size}.png'.
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include <lambent/base.h>

// The values of a pattern's placeholders, for one picture. {ext}: the extension of the model's file name, "obj".
struct output_words {
    const char *model; // {stem}: its file name without the ending; "-": model
    const char *root;  // {dir} is the model's folder below this one; NULL or "": the folder as it is given
    const char *view;  // {view}; NULL: the pattern has none
    int width, height; // {size}: "256" of a square, else "256x128"
    int frame, digits; // {frame}: a number with leading zeros, at least this many digits; OUTPUT_FRAME_OPEN: it stays
};

// The word {frame} stays in the name, until the number of frames is known.
enum { OUTPUT_FRAME_OPEN = -1 };

// The words that a command knows besides {stem}, {ext} and {dir}, as bits.
enum { NAME_VIEW = 1, NAME_SIZE = 2, NAME_FRAME = 4 };

// Returns true if a name has a pattern's brace. "{{" and "}}" write braces.
bool output_name_is_pattern(const char *name);

// Returns true if the pattern has the word, given without braces.
bool output_name_has(const char *pattern, const char *word);

// Checks a pattern: words in braces that are known, no brace left open. `known`: NAME_… bits. Error: LAM_BAD_ARGUMENT.
bool output_name_check(const char *pattern, unsigned known, lam_error *error);

// Returns the name that a checked pattern gives, from malloc. {dir} never leads out of the folder before it: "." and
// ".." are left out of it, and so is a leading '/'. If it is empty, the '/' after it is removed too. Returns NULL if
// memory runs out.
char *output_name_expand(const char *pattern, const struct output_words *words);

// Returns the file name of a model without its extension: `*length` bytes from the result on; "model" if there is none.
const char *output_stem(const char *model, int *length);

#endif
