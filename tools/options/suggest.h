// suggest.h: finds the word nearest to a mistyped one.
#ifndef SUGGEST_H
#define SUGGEST_H

#include <stddef.h>

struct suggestion {
    const char *typed;
    const char *best; // NULL: no word is near enough
    int distance;
};

struct suggestion suggest_start(const char *typed);
void suggest_try(struct suggestion *suggestion, const char *word);
// Suggests the word if the typed one is among its other names, separated by spaces, or NULL if it has none.
void suggest_also(struct suggestion *suggestion, const char *word, const char *others);

#endif
