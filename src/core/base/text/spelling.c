// spelling.c: finds the known word that is most similar to a typed word.
#include "spelling.h"

#include <string.h>

// Returns the smallest edit distance at which another word is too different from `word`. A word that is too long to be
// compared is not similar to any word.
static int limit_of(const char *word)
{
    enum { COMPARED_MAX = 63 }; // the limit of lam_edit_distance
    size_t length = strlen(word);
    return length > COMPARED_MAX ? 0 : length < 2 ? 1 : (int)length / 3 + 2; // one letter is like no other
}

struct spelling spelling_of(const char *word) { return (struct spelling){.word = word, .limit = limit_of(word)}; }

void spelling_try(struct spelling *spelling, const char *candidate)
{
    int distance = lam_word_distance(spelling->word, candidate);
    // of equally similar words, one that begins with the typed word, or otherwise the shorter one
    const size_t length = strlen(spelling->word);
    const bool begins = strncmp(candidate, spelling->word, length) == 0,
               began = spelling->nearest && strncmp(spelling->nearest, spelling->word, length) == 0,
               better = spelling->nearest && (begins != began ? begins : strlen(candidate) < strlen(spelling->nearest));
    if (distance < spelling->limit || (distance == spelling->limit && better)) {
        spelling->limit = distance;
        spelling->nearest = candidate;
    }
}

const char *nearest_word(const char *word, const char *const *words, int count)
{
    const char *nearest = NULL;
    int limit = limit_of(word);
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
