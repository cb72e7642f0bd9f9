// suggest.h: the nearest of a list of words to a mistyped one.
#ifndef SUGGEST_H
#define SUGGEST_H

#include <stddef.h>

struct suggestion {
    const char *typed;
    const char *best; // NULL: nothing near enough
    int distance;
};

struct suggestion suggest_start(const char *typed);
void suggest_try(struct suggestion *suggestion, const char *word);

#endif
