// suggest.c: finds the word nearest to a mistyped one.
#include "suggest.h"

#include <lambent/base.h>

#include <string.h>

struct suggestion suggest_start(const char *typed)
{
    // Accepts a third of the letters wrong, at least one.
    int allowed = (int)strlen(typed) / 3;
    return (struct suggestion){.typed = typed, .distance = allowed < 1 ? 2 : allowed + 1};
}

void suggest_try(struct suggestion *suggestion, const char *word)
{
    int distance = lam_edit_distance(suggestion->typed, word);
    // A prefix counts as near: "back" for "background".
    size_t typed = strlen(suggestion->typed);
    if (typed >= 3 && strncmp(suggestion->typed, word, typed) == 0)
        distance = distance < 1 ? distance : 1;
    if (distance < suggestion->distance) {
        suggestion->distance = distance;
        suggestion->best = word;
    }
}
