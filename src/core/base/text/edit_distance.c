// edit_distance.c: edit distance between words.
#include <lambent/base.h>

#include <string.h>

enum { LENGTH_MAX = 63 }; // longer words are not compared

static int min_int(int a, int b) { return a < b ? a : b; }

// Computes the optimal string alignment distance (Damerau–Levenshtein without repeated edits of one position). Only
// three rows of the table are stored.
int lam_edit_distance(const char *a, const char *b)
{
    int length_a = (int)strnlen(a, LENGTH_MAX + 1), length_b = (int)strnlen(b, LENGTH_MAX + 1);
    if (length_a > LENGTH_MAX || length_b > LENGTH_MAX)
        return LENGTH_MAX;
    int rows[3][LENGTH_MAX + 1];
    for (int j = 0; j <= length_b; j++)
        rows[0][j] = j;
    for (int i = 1; i <= length_a; i++) {
        int *row = rows[i % 3], *previous = rows[(i + 2) % 3], *before_previous = rows[(i + 1) % 3];
        row[0] = i;
        for (int j = 1; j <= length_b; j++) {
            int substituted = previous[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = min_int(substituted, min_int(previous[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = min_int(row[j], before_previous[j - 2] + 1);
        }
    }
    return rows[length_a % 3][length_b];
}
