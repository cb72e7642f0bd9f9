// spelling.h: suggests known names for mistyped words.
#ifndef SPELLING_H
#define SPELLING_H

#include <lambent/base.h>

// A search for the known name that is most similar to a typed word, by lam_word_distance.
struct spelling {
    const char *word;    // as typed
    const char *nearest; // the most similar word so far, or NULL
    int limit;           // the distance of `nearest`; initially, the smallest distance that is too large
};
struct spelling spelling_of(const char *word);
void spelling_try(struct spelling *spelling, const char *candidate);

// Returns the word in `words` with the smallest edit distance to `word`. Returns NULL if this distance exceeds 1 plus a
// third of the length of `word`, or if `word` is another letter.
const char *nearest_word(const char *word, const char *const *words, int count);

// Returns the known name among `words` that a typed word most likely means, or NULL if none is close enough.
const char *meant_word(const char *word, const char *const *words, int count);

#endif
