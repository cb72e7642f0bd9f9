// prefix.c: adds a contract's prefix to the shader sources of a program.
#include "prefix.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

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

bool prefix_applies(const struct contract *contract, const struct declarations *vertex,
                    const struct declarations *fragment, bool *applies, lam_error *error)
{
    bool vertex_lacks = true, fragment_lacks = true;
    *applies = false;
    if (!contract->prefix_vertex || !contract->prefix_fragment)
        return true;
    if ((vertex && !lacks_prefix(contract->prefix_vertex, vertex, true, &vertex_lacks, error)) ||
        !lacks_prefix(contract->prefix_fragment, fragment, false, &fragment_lacks, error))
        return false;
    *applies = vertex_lacks && fragment_lacks;
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
static bool lacks(const char *text, bool vertex, const char *name)
{
    static const char *const types[] = {"vec2", "vec3", "vec4", "float",     "int",
                                        "bool", "mat3", "mat4", "sampler2D", "define"};
    struct declarations d = {0};
    bool read = declarations_read(&d, text, vertex, NULL), declared = false;
    for (int i = 1; i < d.word_count; i++)
        for (size_t k = 0; k < sizeof types / sizeof *types && strcmp(d.words[i].text, name) == 0; k++)
            declared = declared || strcmp(d.words[i - 1].text, types[k]) == 0 || strcmp(d.words[i - 1].text, ",") == 0;
    bool out = read && !declared && declarations_uses(&d, name);
    declarations_free(&d);
    return out;
}

bool prefix_add(const struct contract *contract, const char *vertex, const char *fragment, struct complete_texts *out,
                lam_error *error)
{
    *out = (struct complete_texts){.vertex = vertex, .fragment = fragment};
    out->fragment = out->owned[1] = join(contract->prefix_fragment, fragment);
    out->lines[1] = count_lines(contract->prefix_fragment) + 1;
    if (vertex) {
        // three.js declares vertex colours for materials that use them.
        char prefix[4096];
        snprintf(prefix, sizeof prefix, "%s%s", contract->prefix_vertex,
                 lacks(vertex, true, "color") ? "\nattribute vec3 color;" : "");
        out->vertex = out->owned[0] = join(prefix, vertex);
        out->lines[0] = count_lines(prefix) + 1;
    }
    return (out->fragment && (!vertex || out->vertex)) || fail_memory(error, strlen(fragment));
}

bool prefix_complete(const struct contract *contract, const char *vertex, const char *fragment,
                     struct complete_texts *out, lam_error *error)
{
    *out = (struct complete_texts){.vertex = vertex, .fragment = fragment};
    struct declarations sides[2] = {{0}};
    bool applies = false, ok = true;
    if (contract->prefix_fragment)
        ok = declarations_read(&sides[0], vertex ? vertex : "", true, error) &&
             declarations_read(&sides[1], fragment, false, error) &&
             prefix_applies(contract, vertex ? &sides[0] : NULL, &sides[1], &applies, error);
    declarations_free(&sides[0]);
    declarations_free(&sides[1]);
    return ok && (!applies || prefix_add(contract, vertex, fragment, out, error));
}

void prefix_free(struct complete_texts *texts)
{
    free(texts->owned[0]);
    free(texts->owned[1]);
    *texts = (struct complete_texts){0};
}

bool prefix_read(const struct complete_texts *texts, bool vertex, struct declarations *out, lam_error *error)
{
    const char *text = vertex ? texts->vertex : texts->fragment;
    int lines = texts->lines[vertex ? 0 : 1];
    if (!declarations_read(out, text ? text : "", vertex, error))
        return false;
    for (int i = 0; i < out->word_count; i++)
        out->words[i].line = out->words[i].line > lines ? out->words[i].line - lines : 0;
    for (int i = 0; i < out->count; i++)
        out->items[i].line = out->items[i].line > lines ? out->items[i].line - lines : 0;
    return true;
}
