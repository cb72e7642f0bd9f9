// equations.c: splits the files of src/lighting into definitions, selects those that a shader calls, and writes them as
// plain GLSL.
#include "equations.h"

#include "fail.h"
#include "sources.inc"

#include <stdlib.h>
#include <string.h>

// A definition (function, struct, table or #define) with the comment before it.
struct definition {
    char *lead, *start, *end; // comment and definition; lead == start: no comment
    const char *name;
    size_t name_length;
    int file;
    bool kept;
};

enum { DEFINITIONS_MAX = 256 };

static bool in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static char *next_line(const char *at)
{
    at += strcspn(at, "\n");
    return (char *)(*at ? at + 1 : at);
}

static bool begins(const char *at, const char *with) { return strncmp(at, with, strlen(with)) == 0; }

// Returns the end of a definition: of its first line if that is a declaration or ends with the closing brace, otherwise of the line that
// begins with it; a table ends with a parenthesis.
static char *definition_end(char *at)
{
    if (begins(at, "const ")) {
        while (*at && *at != ')')
            at = next_line(at);
        return next_line(at);
    }
    char *end = next_line(at), *last = end;
    if (end - at > 3 && memcmp(end - 3, ");\n", 3) == 0) // a declaration
        return end;
    while (last > at && (last[-1] == '\n' || last[-1] == ';'))
        last--;
    if (last > at && last[-1] == '}')
        return end;
    while (*at && *at != '}')
        at = next_line(at);
    return next_line(at);
}

static void name_definition(struct definition *definition)
{
    const char *at = definition->start;
    if (begins(at, "#define ")) {
        definition->name = at + 8;
    } else if (begins(at, "STRUCT(")) {
        definition->name = at + 7;
    } else if (begins(at, "const float ")) {
        definition->name = at + 12;
    } else {
        definition->name = strchr(at, '(');
        while (definition->name > at && in_name(definition->name[-1]))
            definition->name--;
    }
    while (in_name(definition->name[definition->name_length]))
        definition->name_length++;
}

// Definitions of the dialect's own words, which GLSL does not need.
static bool is_dialect_definition(const char *at)
{
    static const char *const starts[] = {"#ifdef",        "#endif",           "precision",
                                         "#define FN\n",  "#define STRUCT",   "#define num ",
                                         "#define mask ", "#define vec3_of ", "#define vec4_of "};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (begins(at, starts[i]))
            return true;
    return begins(at, "float num_of(");
}

static int split_definitions(struct definition *definitions, int count, char *source, int file)
{
    char *lead = NULL;
    for (char *at = source; *at;) {
        char *next = next_line(at);
        if (begins(at, "//")) {
            lead = lead ? lead : at;
        } else if (*at == '\n' || is_dialect_definition(at)) {
            lead = NULL;
        } else {
            struct definition *definition = &definitions[count];
            next = *at == '#' ? next : definition_end(at);
            *definition = (struct definition){.lead = lead ? lead : at, .start = at, .end = next, .file = file};
            name_definition(definition);
            lead = NULL;
            if (++count == DEFINITIONS_MAX)
                return count;
        }
        at = next;
    }
    return count;
}

// Marks the definitions that a text names, except after a dot (".xyz"). Returns whether any was not marked before.
static bool mark(struct definition *definitions, int count, const char *at, const char *end)
{
    bool changed = false;
    const char *start = at;
    while (at < end) {
        if (at[0] == '/' && at[1] == '/') {
            at = next_line(at);
        } else if (!in_name(*at)) {
            at++;
        } else {
            size_t length = 1;
            while (at + length < end && in_name(at[length]))
                length++;
            for (int i = 0; i < count && (at == start || at[-1] != '.'); i++) {
                struct definition *p = &definitions[i];
                if (!p->kept && p->name_length == length && memcmp(p->name, at, length) == 0)
                    p->kept = changed = true;
            }
            at += length;
        }
    }
    return changed;
}

// Words of the dialect, and their GLSL equivalents.
static const char *const renamed[][2] = {
    {"num_of", "float"}, {"num", "float"}, {"mask", "bool"}, {"vec3_of", "vec3"}, {"vec4_of", "vec4"}};

static void write_glsl(struct text *text, const char *at, const char *end)
{
    bool comment = false;
    while (at < end) {
        if (*at == '\n')
            comment = false;
        else if (at[0] == '/' && at[1] == '/')
            comment = true;
        if (*at == SPECIALIZE_ERASED) {
            at++;
            continue;
        }
        if (comment || !in_name(*at)) {
            text_add_part(text, at++, 1);
            continue;
        }
        size_t length = 1;
        while (at + length < end && in_name(at[length]))
            length++;
        if (begins(at, "FN ") || begins(at, "SCENE ") || begins(at, "IN_SCENE ")) {
            at += length + 1;
            continue;
        }
        if (length == 6 && begins(at, "STRUCT(")) {
            size_t name = strcspn(at + 7, ")");
            text_add(text, "struct ");
            text_add_part(text, at + 7, name);
            at += 8 + name;
            continue;
        }
        // Numbers lose C's suffix f and the call of num_of.
        if (length == 6 && begins(at, "num_of(") && at[7 + strspn(at + 7, "-.0123456789ef")] == ')') {
            size_t number = strcspn(at + 7, ")");
            text_add_part(text, at + 7, number - (at[6 + number] == 'f'));
            at += 8 + number;
            continue;
        }
        if (*at >= '0' && *at <= '9' && at[length - 1] == 'f') {
            text_add_part(text, at, length - 1);
            at += length;
            continue;
        }
        const char *other = NULL;
        for (size_t i = 0; i < sizeof renamed / sizeof *renamed; i++)
            if (strlen(renamed[i][0]) == length && memcmp(renamed[i][0], at, length) == 0)
                other = renamed[i][1];
        text_add_part(text, other ? other : at, other ? strlen(other) : length);
        at += length;
    }
}

// Writes a definition. The comments of a struct's members are aligned again, because the GLSL types differ in length.
static void write_definition(struct text *text, const struct definition *p)
{
    if (!begins(p->start, "STRUCT(")) {
        write_glsl(text, p->lead, p->end);
        return;
    }
    struct text plain = {0};
    write_glsl(text, p->lead, p->start);
    write_glsl(&plain, p->start, p->end);
    size_t width = 0;
    for (const char *at = plain.bytes; at && *at; at = next_line(at)) {
        size_t code = strcspn(at, ";\n");
        if (*at == ' ' && at[code] == ';' && at[code + 1] == ' ' && code > width)
            width = code;
    }
    for (const char *at = plain.bytes; at && *at; at = next_line(at)) {
        size_t code = strcspn(at, ";\n");
        const char *next = next_line(at), *comment = at[code] == ';' ? at + code + 1 : next;
        comment += strspn(comment, " ");
        if (*at == ' ' && begins(comment, "//")) {
            text_add_part(text, at, code + 1);
            text_print(text, "%*s", (int)(width - code + 1), "");
            text_add_part(text, comment, (size_t)(next - comment));
        } else {
            text_add_part(text, at, (size_t)(next - at));
        }
    }
    text->failed |= plain.failed;
    free(plain.bytes);
}

// --- all files

enum { FILES = 10 };

struct equations {
    struct text sources[FILES];
    struct definition definitions[DEFINITIONS_MAX];
    struct source_span spans[DEFINITIONS_MAX + 1];
    int count;
};

// Marks the definitions that the calls need, directly or indirectly. Returns the number of spans; the calls are the first.
static int keep(struct equations *w, char *calls)
{
    char *calls_end = calls + strlen(calls);
    for (int i = 0; i < w->count; i++)
        w->definitions[i].kept = false;
    mark(w->definitions, w->count, calls, calls_end);
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = 0; i < w->count; i++)
            if (w->definitions[i].kept)
                changed |= mark(w->definitions, w->count, w->definitions[i].start, w->definitions[i].end);
    }
    int count = 0;
    w->spans[count++] = (struct source_span){calls, calls_end};
    for (int i = 0; i < w->count; i++)
        if (w->definitions[i].kept)
            w->spans[count++] = (struct source_span){w->definitions[i].start, w->definitions[i].end};
    return count;
}

static void write_kept(struct text *text, const struct equations *w)
{
    static const char *const titles[FILES] = {
        "functions of vectors and numbers",
        "reflection of the light from one direction at a point of a surface",
        "kinds of light",
        "light that arrives at a point: direction, distance, attenuation and cone",
        "light that leaves a point: its terms and their sum",
        "a point before it is lit: its normal and tangent, and what maps make of its material",
        "layers of physical materials",
        "light through the layers of a physical material",
        "the light of an environment around a point",
        "tone curves: from light to colours of a screen"};
    int file = -1;
    bool define = false;
    for (int i = 0; i < w->count; i++) {
        const struct definition *p = &w->definitions[i];
        if (!p->kept)
            continue;
        if (p->file != file)
            text_print(text, "\n// --- %s\n\n", titles[p->file]);
        bool is_define = *p->start == '#', one_line = next_line(p->start) == p->end;
        if (p->file == file && !(define && is_define && p->lead == p->start) && !(p->file == 0 && one_line))
            text_add(text, "\n");
        file = p->file;
        define = is_define;
        write_definition(text, p);
    }
}

void equations_add(struct text *text, char *calls, const struct known_condition *known)
{
    static const char *const sources[FILES] = {text_prelude_glsl,   text_lobes_h, text_light_kinds_h, text_lights_h,
                                               text_sum_h,          text_point_h, text_layer_kinds_h, text_layers_h,
                                               text_surroundings_h, text_tone_h};
    struct equations *w = calloc(1, sizeof *w);
    bool ok = w != NULL;
    for (int i = 0; ok && i < FILES; i++) {
        specialize_conditions(&w->sources[i], sources[i], known);
        ok = !w->sources[i].failed;
        if (ok)
            w->count = split_definitions(w->definitions, w->count, w->sources[i].bytes, i);
    }
    if (ok) {
        while (specialize_members(w->spans, keep(w, calls)))
            ;
        write_kept(text, w);
        char *to = calls; // closes the gaps of erased lines
        for (const char *from = calls; *from; from++)
            if (*from != SPECIALIZE_ERASED)
                *to++ = *from;
        *to = 0;
    } else {
        text->failed = true;
        fail(&text->error, LAM_LIMIT, "out of memory");
    }
    for (int i = 0; w && i < FILES; i++)
        free(w->sources[i].bytes);
    free(w);
}
