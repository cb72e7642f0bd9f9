// prefix.c: adds a contract's prefix to the shader sources of a program.
#include "prefix.h"
#include "fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool shares_a_name(const struct declarations *a, const struct declarations *b)
{
    for (int i = 0; i < a->count; i++)
        for (int k = 0; k < b->count; k++)
            if (strcmp(a->items[i].name, b->items[k].name) == 0)
                return true;
    return false;
}

// Determines whether the contract's engine completes this source.
static bool lacks_prefix(const char *prefix, const struct declarations *own, bool vertex, bool *lacks, lam_error *error)
{
    struct declarations before = {0};
    *lacks = false;
    if (own->version)
        return true;
    if (!declarations_read(&before, prefix, vertex, error))
        return false;
    *lacks = !shares_a_name(own, &before);
    declarations_free(&before);
    return true;
}

// Determines whether a contract's engine completes these sources.
static bool applies(const struct contract *contract, const struct complete_texts *own, bool *out, lam_error *error)
{
    bool vertex_lacks = true, fragment_lacks = true;
    *out = false;
    if (!contract->prefix_vertex || !contract->prefix_fragment)
        return true;
    if ((own->vertex && !lacks_prefix(contract->prefix_vertex, &own->sides[0], true, &vertex_lacks, error)) ||
        !lacks_prefix(contract->prefix_fragment, &own->sides[1], false, &fragment_lacks, error))
        return false;
    *out = vertex_lacks && fragment_lacks;
    return true;
}

static int count_lines(const char *text)
{
    int count = 1;
    for (; *text; text++)
        count += *text == '\n';
    return count;
}

// Returns a new string: the prefix, then a line that restores the source's own line numbers, then the source. The
// caller frees the string.
static char *join(const char *prefix, const char *text)
{
    size_t size = strlen(prefix) + strlen(text) + 20;
    char *out = malloc(size);
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0) // a byte order mark is allowed only at the beginning
        text += 3;
    // The number in #line is the number of the next line. In older versions of GLSL, the number is one less.
    bool modern = strncmp(prefix, "#version 3", 10) == 0;
    if (out)
        snprintf(out, size, "%s\n#line %d\n%s", prefix, modern ? 1 : 0, text);
    return out;
}

// Returns whether a source reads a name that it does not declare.
static bool lacks(const struct declarations *d, const char *name)
{
    static const char *const types[] = {"vec2", "vec3", "vec4", "float",     "int",
                                        "bool", "mat3", "mat4", "sampler2D", "define"};
    bool declared = false;
    for (int i = 1; i < d->word_count; i++)
        for (size_t k = 0; k < sizeof types / sizeof *types && word_is(d, i, name); k++)
            declared = declared || word_is(d, i - 1, types[k]) || word_is(d, i - 1, ",");
    return !declared && declarations_uses(d, name);
}

static bool add_prefix(struct program_texts *t, const struct contract *contract, lam_error *error)
{
    const struct complete_texts *own = &t->own;
    struct complete_texts *out = &t->completed;
    prefix_free(out);
    out->fragment = out->owned[1] = join(contract->prefix_fragment, own->fragment);
    out->lines[1] = count_lines(contract->prefix_fragment) + 1;
    if (own->vertex) {
        // three.js declares vertex colours for materials that use them.
        char prefix[4096];
        snprintf(prefix, sizeof prefix, "%s%s", contract->prefix_vertex,
                 lacks(&own->sides[0], "color") ? "\nattribute vec3 color;" : "");
        out->vertex = out->owned[0] = join(prefix, own->vertex);
        out->lines[0] = count_lines(prefix) + 1;
    }
    return (out->fragment && (!own->vertex || out->vertex)) ? t->read(t->user, out, error)
                                                            : fail_memory(error, strlen(own->fragment));
}

const struct complete_texts *prefix_texts(struct program_texts *t, const struct contract *contract, lam_error *error)
{
    const char *prefix = contract->prefix_fragment;
    bool needed = false;
    if (!applies(contract, &t->own, &needed, error))
        return NULL;
    if (!needed)
        return &t->own;
    bool ready = t->completed.fragment && strncmp(t->completed.fragment, prefix, strlen(prefix)) == 0;
    return ready || add_prefix(t, contract, error) ? &t->completed : NULL;
}

void prefix_free(struct complete_texts *texts)
{
    for (int i = 0; i < 2; i++) {
        free(texts->owned[i]);
        declarations_free(&texts->sides[i]);
    }
    *texts = (struct complete_texts){0};
}

bool prefix_read(void *user, struct complete_texts *texts, lam_error *error)
{
    (void)user;
    for (int s = 0; s < 2; s++) {
        const char *text = s ? texts->fragment : texts->vertex;
        struct declarations *d = &texts->sides[s];
        if (!declarations_read(d, text ? text : "", s == 0, error))
            return false;
        int lines = texts->lines[s];
        for (int i = 0; i < d->word_count; i++)
            d->words[i].line = d->words[i].line > lines ? d->words[i].line - lines : 0;
        for (int i = 0; i < d->count; i++)
            d->items[i].line = d->items[i].line > lines ? d->items[i].line - lines : 0;
    }
    return true;
}

// --- normalises line endings, and declares the fixed-function state.

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
