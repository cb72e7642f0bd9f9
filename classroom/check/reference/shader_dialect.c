// shader_dialect.c: determines the shading language of a pair of shaders, and replaces precision qualifiers.
#include "draw_request.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

// Names that do not exist in OpenGL ES.
static const char *const desktop_names[] = {"gl_Vertex",
                                            "gl_Normal",
                                            "gl_Color",
                                            "gl_MultiTexCoord0",
                                            "gl_NormalMatrix",
                                            "gl_ModelViewMatrix",
                                            "gl_ModelViewProjectionMatrix",
                                            "gl_ProjectionMatrix",
                                            "gl_FrontColor",
                                            "gl_BackColor",
                                            "gl_TexCoord",
                                            "gl_LightSource",
                                            "gl_FrontMaterial",
                                            "gl_LightModel",
                                            "ftransform"};

static bool is_web(const struct shader_interface *r)
{
    if (r->vertex.version || r->fragment.version)
        return false;
    for (size_t i = 0; i < sizeof desktop_names / sizeof *desktop_names; i++)
        if (declarations_uses(&r->vertex, desktop_names[i]) || declarations_uses(&r->fragment, desktop_names[i]))
            return false;
    static const char *const words[] = {"precision", "highp", "mediump", "lowp"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (declarations_uses(&r->vertex, words[i]) || declarations_uses(&r->fragment, words[i]))
            return true;
    return false;
}

lam_check_language shader_dialect_language(const struct shader_interface *r)
{
    const struct declarations *d = r->vertex.version > r->fragment.version ? &r->vertex : &r->fragment;
    if (strcmp(d->profile, "es") == 0 || d->version == 100 || is_web(r))
        return LAM_CHECK_LANGUAGE_ES;
    if (d->version < 150 || strcmp(d->profile, "compatibility") == 0)
        return LAM_CHECK_LANGUAGE_COMPATIBILITY;
    return LAM_CHECK_LANGUAGE_CORE;
}

// Finds the next `mediump` or `lowp` that is a separate word, and its length. Returns NULL if there is none.
static const char *find_qualifier(const char *text, size_t *length)
{
    for (const char *c = text; *c;) {
        if (!isalnum((unsigned char)*c) && *c != '_') {
            c++;
            continue;
        }
        const char *word = c;
        while (isalnum((unsigned char)*c) || *c == '_')
            c++;
        *length = (size_t)(c - word);
        if ((*length == 7 && strncmp(word, "mediump", 7) == 0) || (*length == 4 && strncmp(word, "lowp", 4) == 0))
            return word;
    }
    return NULL;
}

// Returns the end of the first `precision … float;` in the source, after which another statement may follow. Returns
// NULL if there is no such statement.
static const char *after_precision(const char *text)
{
    static const char word[] = "precision";
    for (const char *c = text; (c = strstr(c, word)); c += sizeof word - 1) {
        const char *end = strchr(c, ';'), *type = strstr(c, "float");
        if (isspace((unsigned char)c[sizeof word - 1]) && end && type && type < end)
            return end + 1;
    }
    return NULL;
}

// Returns whether textures are read with lowp, the default precision of samplers in OpenGL ES.
static bool reads_low(const char *text) { return strstr(text, "sampler2D") && after_precision(text); }

bool shader_dialect_lowers_precision(const char *text)
{
    size_t length;
    return find_qualifier(text, &length) != NULL || reads_low(text);
}

// Appends characters to a text. Returns the position after the new characters.
static size_t copy(char *out, size_t at, const char *letters, size_t count)
{
    memcpy(out + at, letters, count);
    return at + count;
}

char *shader_dialect_highp(const char *text)
{
    static const char of_samplers[] = " precision highp sampler2D;";
    size_t at = 0, length = 0;
    const char *place = reads_low(text) ? after_precision(text) : NULL;
    char *out = malloc(2 * strlen(text) + sizeof of_samplers); // `highp` is one letter longer than `lowp`
    for (const char *word; out && (word = find_qualifier(text, &length)); text = word + length) {
        if (place && place <= word) {
            at = copy(out, at, text, (size_t)(place - text));
            at = copy(out, at, of_samplers, sizeof of_samplers - 1);
            text = place;
            place = NULL;
        }
        at = copy(out, at, text, (size_t)(word - text));
        at = copy(out, at, "highp", 5);
    }
    if (out && place) {
        at = copy(out, at, text, (size_t)(place - text));
        at = copy(out, at, of_samplers, sizeof of_samplers - 1);
        text = place;
    }
    if (out)
        strcpy(out + at, text);
    return out;
}

const char *shader_dialect_skip_mark(const char *text)
{
    return strncmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
}
