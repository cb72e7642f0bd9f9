// suggest.c: the nearest of a list of words to a mistyped one.
#include "suggest.h"

#include <lambent/base.h>

#include <string.h>

struct suggestion suggest_start(const char *typed)
{
    // A third of the letters may be wrong, and one in the shortest words.
    int allowed = (int)strlen(typed) / 3;
    return (struct suggestion){.typed = typed, .distance = allowed < 1 ? 2 : allowed + 1};
}

void suggest_try(struct suggestion *suggestion, const char *word)
{
    int distance = lam_edit_distance(suggestion->typed, word);
    // What was typed may also be the word's beginning: "back" for "background".
    size_t typed = strlen(suggestion->typed);
    if (typed >= 3 && strncmp(suggestion->typed, word, typed) == 0)
        distance = distance < 1 ? distance : 1;
    if (distance < suggestion->distance) {
        suggestion->distance = distance;
        suggestion->best = word;
    }
}
