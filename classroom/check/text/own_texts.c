// own_texts.c: normalises line endings, and declares the fixed-function state.
#include "own_texts.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

// Returns a copy in which single carriage returns (the line endings of old Macs) are replaced by line feeds. Returns
// NULL if the source contains no single carriage return. Also returns NULL, and sets *ok to false, if memory runs out.
static char *mend_lines(const char *text, bool *ok)
{
    const char *lone = text ? strchr(text, '\r') : NULL;
    while (lone && lone[1] == '\n')
        lone = strchr(lone + 1, '\r');
    if (!lone)
        return NULL;
    char *copy = malloc(strlen(text) + 1);
    *ok = *ok && copy;
    if (!copy)
        return NULL;
    strcpy(copy, text);
    for (char *c = copy; *c; c++)
        if (*c == '\r' && c[1] != '\n')
            *c = '\n';
    return copy;
}

bool own_texts_make(const char *vertex, const char *fragment, struct own_texts *out, lam_error *error)
{
    bool ok = true, rewritten[2] = {true, true};
    *out = (struct own_texts){.lines = {mend_lines(vertex, &ok), mend_lines(fragment, &ok)}};
    out->vertex = out->lines[0] ? out->lines[0] : vertex;
    out->fragment = out->lines[1] ? out->lines[1] : fragment;
    const char *plain[] = {out->vertex, out->fragment};
    for (int i = 0; i < 2; i++)
        out->rewritten[i] = plain[i] ? fixed_state_rewrite(plain[i], plain[1 - i], &rewritten[i]) : NULL;
    out->vertex = out->rewritten[0] ? out->rewritten[0] : out->vertex;
    out->fragment = out->rewritten[1] ? out->rewritten[1] : out->fragment;
    return (ok && rewritten[0] && rewritten[1]) || fail_memory(error, fragment ? strlen(fragment) : 1);
}

void own_texts_free(struct own_texts *texts)
{
    for (int i = 0; i < 2; i++) {
        free(texts->lines[i]);
        free(texts->rewritten[i]);
    }
    *texts = (struct own_texts){0};
}
