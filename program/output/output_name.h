// output_name.h: expands the patterns for names of pictures, such as 'thumbs/{dir}/{stem}-{size}.png'.
#ifndef OUTPUT_NAME_H
#define OUTPUT_NAME_H

#include <lambent/base.h>

// The values of a pattern's placeholders for one picture. {ext} is the extension of the model's file name, such as
// "obj".
struct output_words {
    const char *model;  // {stem} is the model's file name without its extension, or "model" for "-"
    const char *root;   // {dir} is the model's folder relative to this folder; may be NULL or ""
    const char *view;   // {view}; NULL if the pattern does not contain it
    const char *show;   // {show}
    double azimuth_deg; // {azimuth}, at most six digits
    int width, height;  // {size}: "256" for a square, otherwise "256x128"
    int frame, digits;  // {frame} with at least `digits` digits; OUTPUT_FRAME_OPEN keeps the placeholder
};

// Keeps the placeholder {frame} in the name until the number of frames is known.
enum { OUTPUT_FRAME_OPEN = -1 };

// The placeholders that a command supports in addition to {stem}, {ext} and {dir}, as bits.
enum { NAME_VIEW = 1, NAME_SIZE = 2, NAME_FRAME = 4 };

// Returns true if a name contains a brace and is therefore a pattern. In patterns, "{{" and "}}" mean literal braces.
bool output_name_is_pattern(const char *name);

// Returns true if the pattern contains the placeholder, which is given without braces.
bool output_name_has(const char *pattern, const char *placeholder);

// Checks that a pattern contains only known placeholders and no unmatched brace. `known` is a set of NAME_… bits. Fails
// with LAM_BAD_ARGUMENT.
bool output_name_check(const char *pattern, unsigned known, lam_error *error);

// Expands a checked pattern and returns the name, allocated with malloc. {dir} never contains ".", ".." or a leading
// "/", so the result stays inside the pattern's folder. If {dir} is empty, the "/" after it is removed too. Returns
// NULL if memory runs out.
char *output_name_expand(const char *pattern, const struct output_words *words);

// Returns a model's file name, and sets *length to the number of its bytes before the extension. Returns "model" if
// there is no name.
const char *output_stem(const char *model, int *length);

#endif
