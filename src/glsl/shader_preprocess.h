// shader_preprocess.h: a preprocessor for shader sources.
//
//     //@if NAME… //@elif NAME… //@else //@end    copies the lines of the first branch with a flag that is on;
//                                                 !NAME negates a flag; branches nest
//     @NAME@                                      the value of that name
//     $(X)                                        X, or with the flag back_material (front ? X : back_X)
//
// An unknown name is an error, so that a misspelt flag cannot drop lines silently.
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

// Appends the preprocessed source. On an error `text` fails, with the error's sentence.
void preprocess_add(struct text *text, const char *source, const struct preprocess_words *words);

#endif
