// suggest.c: the nearest of a list of words to a mistyped one.
#include "suggest.h"

#include <string.h>

enum { LONGEST = 40 }; // words longer than this are not worth a guess

static int least(int a, int b) { return a < b ? a : b; }

// The Damerau–Levenshtein distance in its "optimal string alignment" form, three rows at a time.
int edit_distance(const char *a, const char *b)
{
    int length_a = (int)strnlen(a, LONGEST + 1), length_b = (int)strnlen(b, LONGEST + 1);
    if (length_a > LONGEST || length_b > LONGEST)
        return LONGEST;
    int rows[3][LONGEST + 1];
    for (int j = 0; j <= length_b; j++)
        rows[0][j] = j;
    for (int i = 1; i <= length_a; i++) {
        int *now = rows[i % 3], *before = rows[(i + 2) % 3], *earlier = rows[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= length_b; j++) {
            int change = before[j - 1] + (a[i - 1] != b[j - 1]);
            now[j] = least(change, least(before[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = least(now[j], earlier[j - 2] + 1);
        }
    }
    return rows[length_a % 3][length_b];
}

struct suggestion suggest_start(const char *typed)
{
    // A third of the letters may be wrong, and one in the shortest words.
    int allowed = (int)strnlen(typed, LONGEST) / 3;
    return (struct suggestion){.typed = typed, .distance = allowed < 1 ? 2 : allowed + 1};
}

void suggest_try(struct suggestion *suggestion, const char *word)
{
    int distance = edit_distance(suggestion->typed, word);
    // What was typed may also be the word's beginning: "back" for "background".
    size_t typed = strlen(suggestion->typed);
    if (typed >= 3 && strncmp(suggestion->typed, word, typed) == 0)
        distance = least(distance, 1);
    if (distance < suggestion->distance) {
        suggestion->distance = distance;
        suggestion->best = word;
    }
}
