// fail.c: fills a lam_error.
#include "fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool fail(lam_error *error, lam_code code, const char *format, ...)
{
    if (!error)
        return false;
    error->code = code;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    if (length < 0)
        error->text[0] = 0;
    if (length >= (int)sizeof error->text) {
        size_t at = sizeof error->text - 4;
        while (at > 0 && ((unsigned char)error->text[at] & 0xc0) == 0x80) // never inside a UTF-8 character
            at--;
        memcpy(error->text + at, "…", sizeof "…");
    }
    for (unsigned char *c = (unsigned char *)error->text; *c; c++)
        if (*c < 32 || *c == 127)
            *c = '?';
    return false;
}

bool fail_memory(lam_error *error, size_t bytes)
{
    return fail(error, LAM_LIMIT, "out of memory: %.1f MB more were needed", (double)bytes / 1e6);
}

// Levenshtein's distance by rows; words longer than the row count as far.
static int distance(const char *a, const char *b)
{
    enum { LONGEST = 63 };
    int row[LONGEST + 1];
    size_t na = strlen(a), nb = strlen(b);
    if (na > LONGEST || nb > LONGEST)
        return LONGEST;
    for (size_t j = 0; j <= nb; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            int best = diagonal + (a[i - 1] != b[j - 1]);
            if (row[j] + 1 < best)
                best = row[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            diagonal = row[j];
            row[j] = best;
        }
    }
    return row[nb];
}

const char *nearest_word(const char *word, const char *const *words, int count)
{
    const char *nearest = NULL;
    int least = (int)strlen(word) / 3 + 2;
    for (int i = 0; i < count; i++) {
        int d = distance(word, words[i]);
        if (d < least) {
            least = d;
            nearest = words[i];
        }
    }
    return nearest;
}
