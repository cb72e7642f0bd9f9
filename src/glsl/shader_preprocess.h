// shader_preprocess.h: a preprocessor for shader sources.
//
//     //@if NAME… //@elif NAME… //@else //@end    copies the lines of the first branch with a flag that is on;
//                                                 !NAME negates a flag; branches nest
//     @NAME@                                      the value of that name; as a line of its own, the value's lines
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

// The tables while they are made. Zero is empty; names and texts that are put there are not copied.
enum { PREPROCESS_FLAGS_MAX = 112, PREPROCESS_VALUES_MAX = 56, PREPROCESS_MADE_MAX = 32 };
struct preprocess_tables {
    struct preprocess_flag flags[PREPROCESS_FLAGS_MAX + 1];
    struct preprocess_value values[PREPROCESS_VALUES_MAX + 1];
    struct text made[PREPROCESS_MADE_MAX]; // of the values whose row has no text yet, in their order
    int flag_count, value_count, made_count;
};
void preprocess_flag(struct preprocess_tables *tables, const char *name, bool on);
void preprocess_value(struct preprocess_tables *tables, const char *name, const char *text);
void preprocess_number(struct preprocess_tables *tables, const char *name, int number);
// A value that the caller writes.
struct text *preprocess_text(struct preprocess_tables *tables, const char *name);
// The finished tables, valid until preprocess_free. An error of a written value becomes that of `text`.
struct preprocess_words preprocess_finish(struct preprocess_tables *tables, struct text *text);
void preprocess_free(struct preprocess_tables *tables);

// Appends the preprocessed source. On an error `text` fails, with the error's sentence.
void preprocess_add(struct text *text, const char *source, const struct preprocess_words *words);

#endif
