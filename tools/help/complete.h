// complete.h: completions for a command line.
#ifndef COMPLETE_H
#define COMPLETE_H

#include "options.h"

// The word that the user is typing: the first `before_length` bytes of `before`, which are complete, and the incomplete
// text `prefix`.
struct typed_word {
    const char *before, *prefix;
    int before_length;
};

// If the candidate begins with `prefix`, prints the completed word, `ending`, a tab and the summary. `summary` may be
// NULL.
void complete_offer(const struct typed_word *typed, const char *candidate, const char *ending, const char *summary);

// Tells the shell to complete the names of files.
void complete_files(void);

// Prints the names in the model that `words` names, if they are candidates for the value of the option: --hide,
// --material NAME@…, --animation. Returns false if they are not.
bool complete_from_model(const struct option *option, const struct typed_word *typed, int count, char **words);

// Prints the candidates for the value of an option.
void complete_value(const struct option *option, const struct typed_word *typed);

#endif
