// complete.h: completions for a command line.
#ifndef COMPLETE_H
#define COMPLETE_H

#include "options.h"

// The word that the user is typing: the first `before_length` bytes of `before` are finished, and `prefix` is the rest,
// which is to be completed.
struct typed_word {
    const char *before, *prefix;
    int before_length;
};

// Prints a candidate if it begins with `prefix`: the whole word, then `ending`, a tab and the summary, which may be
// NULL.
void complete_offer(const struct typed_word *typed, const char *candidate, const char *ending, const char *summary);

// Lets the shell add the names of files that begin with `prefix`.
void complete_files(void);

// Prints the candidates for the value of an option.
void complete_value(const struct option *option, const struct typed_word *typed);

#endif
