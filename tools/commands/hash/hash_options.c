// hash_options.c: applies the options that a hash file names, if the command line names none that change the picture.
#include "hash.h"

#include <stdlib.h>
#include <string.h>

#include "batch_key.h"
#include "command_table.h"
#include "console.h"

enum { WORDS_MAX = 512 };

// Splits a line into words as a shell does: blanks separate, single quotes keep, \' is a quote. Changes `text`.
static int split(char *text, char **words)
{
    int count = 0;
    char *to = text;
    for (const char *from = text; *from && count < WORDS_MAX;) {
        from += strspn(from, " ");
        if (!*from)
            break;
        words[count++] = to;
        for (bool quoted = false; *from && (quoted || *from != ' '); from++)
            if (*from == '\'')
                quoted = !quoted;
            else if (!quoted && *from == '\\' && from[1])
                *to++ = *++from;
            else
                *to++ = *from;
        from += *from == ' '; // before `to` may reach it
        *to++ = 0;
    }
    return count;
}

bool hash_options_take(const struct hash_file *file, const char *path, const struct options *given, struct options *own,
                       char **kept, lam_error *error)
{
    char *words[WORDS_MAX], *now = batch_options_given(given);
    bool wanted = now && !*now && *file->options, ok = now && options_copy(own, given);
    free(now);
    *kept = ok && wanted ? strdup(file->options) : NULL;
    if (!ok || (wanted && !*kept))
        return complain(error, LAM_LIMIT, "out of memory");
    if (!wanted)
        return true;
    lam_error reason = {0};
    int count = split(*kept, words);
    ok = options_parse(count, words, find_groups("hash"), own, &reason) == 0;
    now = ok ? batch_options_given(own) : NULL;
    ok = now && strcmp(now, file->options) == 0; // nothing else: no output, no files
    free(now);
    return ok || complain(error, LAM_CANNOT_READ,
                          "%.300s:3: found '%.100s', expected options that change the picture%s%.200s", path,
                          file->options, *reason.text ? ": " : "", reason.text);
}
