// shader_preprocess.h: text with choices in it: lines that a flag lets through, and places that a value fills.
//
//     //@if NAME …  //@elif NAME …  //@else …  //@end    lines that stand only where the flag is true;
//     "!NAME" turns it; nest freely
//     @NAME@                                           the value of that name
//     $(X)       X, or where the flag `back_material` is true (front ? X : back_X)
//
// A name that is in no table stops everything: a misspelt flag must not leave lines out in silence.
#ifndef SHADER_PREPROCESS_H
#define SHADER_PREPROCESS_H

#include "text_builder.h"

struct preprocess_flag {
    const char *name;
    bool on;
};

struct preprocess_value {
    const char *name;
    const char *text;
};

// Tables end with a NULL name.
struct preprocess_words {
    const struct preprocess_flag *flags;
    const struct preprocess_value *values;
};

// Appends a template's lines.
void preprocess_add(struct text *text, const char *source, const struct preprocess_words *words);

#endif
