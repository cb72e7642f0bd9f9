// suggest.c: finds the known word that is most similar to a mistyped word.
#include "suggest.h"

#include <lambent/base.h>

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

struct suggestion suggest_start(const char *typed)
{
    // At most a third of the letters may differ; in short words, one letter may differ.
    int allowed = (int)strlen(typed) / 3;
    return (struct suggestion){.typed = typed, .distance = allowed < 1 ? 2 : allowed + 1};
}

void suggest_try(struct suggestion *suggestion, const char *word)
{
    int distance = lam_word_distance(suggestion->typed, word);
    // If an equally similar word is a prefix of the best word so far, the prefix is preferred.
    const char *best = suggestion->best;
    bool shorter = best && distance == suggestion->distance && strncmp(best, word, strlen(word)) == 0;
    if (distance < suggestion->distance || shorter) {
        suggestion->distance = distance;
        suggestion->best = word;
    }
}

void suggest_also(struct suggestion *suggestion, const char *word, const char *others)
{
    for (size_t length; others && *others; others += length + (others[length] == ' ')) {
        char other[64];
        length = strcspn(others, " ");
        snprintf(other, sizeof other, "%.*s", (int)length, others);
        if (lam_word_distance(suggestion->typed, other) == 0 && suggestion->distance > 0) {
            suggestion->distance = 0;
            suggestion->best = word;
        }
    }
}
