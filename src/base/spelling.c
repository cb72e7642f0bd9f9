// spelling.c: the nearest of several words.
#include "spelling.h"

#include <string.h>

struct spelling spelling_of(const char *word)
{
    return (struct spelling){.word = word, .limit = (int)strlen(word) / 3 + 2};
}

void spelling_try(struct spelling *spelling, const char *candidate)
{
    int distance = lam_word_distance(spelling->word, candidate);
    if (distance < spelling->limit) {
        spelling->limit = distance;
        spelling->nearest = candidate;
    }
}

const char *nearest_word(const char *word, const char *const *words, int count)
{
    const char *nearest = NULL;
    int limit = (int)strlen(word) / 3 + 2;
    for (int i = 0; i < count; i++) {
        int distance = lam_edit_distance(word, words[i]);
        if (distance < limit) {
            limit = distance;
            nearest = words[i];
        }
    }
    return nearest;
}

const char *meant_word(const char *word, const char *const *words, int count)
{
    struct spelling spelling = spelling_of(word);
    for (int i = 0; i < count; i++)
        spelling_try(&spelling, words[i]);
    return spelling.nearest;
}
