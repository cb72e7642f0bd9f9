// spelling.h: words that people mistype.
#ifndef SPELLING_H
#define SPELLING_H

#include <lambent/base.h>

// The word of `words` with the smallest edit distance to `word`, at most a third of its length; NULL: none is that near.
const char *nearest_word(const char *word, const char *const *words, int count);

#endif
