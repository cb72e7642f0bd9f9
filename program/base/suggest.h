// suggest.h: finds the known word that is most similar to a mistyped word.
#ifndef SUGGEST_H
#define SUGGEST_H

#include <stddef.h>

struct suggestion {
    const char *typed;
    const char *best; // NULL if no word is similar enough
    int distance;
};

struct suggestion suggest_start(const char *typed);
void suggest_try(struct suggestion *suggestion, const char *word);
// Suggests `word` if the typed word is in `others`, a list separated by spaces. `others` may be NULL.
void suggest_also(struct suggestion *suggestion, const char *word, const char *others);

#endif
