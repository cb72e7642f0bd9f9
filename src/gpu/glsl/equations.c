// equations.c: splits the files of src/core/lighting into definitions, and writes the definitions that a shader calls.
#include "glsl_text.h"

#include "fail.h"
#include "sources.inc"

#include <stdlib.h>
#include <string.h>

// A definition (function, struct, table or #define) with its comment.
struct definition {
    char *lead, *start, *end; // comment and definition; without a comment, lead == start
    const char *name;
    size_t name_length;
    int file;
    bool spaced; // an empty line precedes the definition
    bool kept;
};

enum { DEFINITIONS_MAX = 400 };

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

// Returns the end of a definition. If the first line of the definition contains a semicolon, the definition ends with
// that line. Otherwise the definition ends with the line that begins with the closing brace or, for a table, with a
// parenthesis.
static char *definition_end(char *at)
{
    bool table = begins(at, "const ");
    size_t code = strcspn(at, ";\n");
    const char *comment = strstr(at, "//");
    if (at[code] == ';' && !(comment && comment < at + code))
        return next_line(at);
    while (*at && *at != (table ? ')' : '}'))
        at = next_line(at);
    return next_line(at);
}

static void name_definition(struct definition *definition)
{
    const char *at = definition->start;
    if (begins(at, "#define ")) {
        definition->name = at + 8;
    } else if (begins(at, "struct ")) {
        definition->name = at + 7;
    } else {
        if (begins(at, "layout("))
            at = strchr(at, ')') + 1;
        definition->name = at + strcspn(at, "([;=");
        while (definition->name > at && definition->name[-1] == ' ')
            definition->name--;
        while (definition->name > at && in_name(definition->name[-1]))
            definition->name--;
    }
    while (in_name(definition->name[definition->name_length]))
        definition->name_length++;
}

static int split_definitions(struct definition *definitions, int count, char *source, int file)
{
    char *lead = NULL;
    bool spaced = true;
    for (char *at = source; *at;) {
        char *next = next_line(at);
        if (begins(at, "//")) {
            lead = lead ? lead : at;
        } else if (*at == '\n') {
            lead = NULL;
            spaced = true;
        } else {
            struct definition *definition = &definitions[count];
            next = *at == '#' ? next : definition_end(at);
            *definition =
                (struct definition){.lead = lead ? lead : at, .start = at, .end = next, .file = file, .spaced = spaced};
            name_definition(definition);
            lead = NULL;
            spaced = false;
            if (++count == DEFINITIONS_MAX)
                return count;
        }
        at = next;
    }
    return count;
}

enum { BUCKETS = 256 };
struct definition_index {
    int first[BUCKETS], next[DEFINITIONS_MAX]; // chains of definitions whose names have the same hash; -1 ends a chain
};

static unsigned hash_of(const char *name, size_t length)
{
    unsigned hash = (unsigned)length;
    for (size_t i = 0; i < length; i++)
        hash = hash * 31 + (unsigned char)name[i];
    return hash % BUCKETS;
}

// Marks the definitions whose names occur in the definition `from`. Names after a dot (".xyz") are ignored.
static bool mark(struct definition *definitions, const struct definition_index *index, const struct definition *from)
{
    bool changed = false;
    for (const char *at = from->start; at < from->end;) {
        if (at[0] == '/' && at[1] == '/') {
            at = next_line(at);
        } else if (!in_name(*at)) {
            at++;
        } else {
            size_t length = 1;
            while (at + length < from->end && in_name(at[length]))
                length++;
            int i = at > from->start && at[-1] == '.' ? -1 : index->first[hash_of(at, length)];
            for (; i >= 0; i = index->next[i]) {
                struct definition *p = &definitions[i];
                if (!p->kept && p->name_length == length && memcmp(p->name, at, length) == 0)
                    p->kept = changed = true;
            }
            at += length;
        }
    }
    return changed;
}

// Appends text without its erased bytes.
static void write_rest(struct text *text, const char *at, const char *end)
{
    for (const char *erased; at < end; at = erased) {
        at += strspn(at, "\1");
        erased = memchr(at, SPECIALIZE_ERASED, at < end ? (size_t)(end - at) : 0);
        erased = erased ? erased : end;
        if (at < erased)
            text_add_part(text, at, (size_t)(erased - at));
    }
}

// Writes a definition. The comments of a struct's members are aligned again, because the names of types have different
// lengths in GLSL.
static void write_definition(struct text *text, const struct definition *p)
{
    if (!begins(p->start, "struct ")) {
        write_rest(text, p->lead, p->end);
        return;
    }
    struct text plain = {0};
    write_rest(text, p->lead, p->start);
    write_rest(&plain, p->start, p->end);
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

// --- all sources

enum { EQUATIONS = 12, SOURCES_MAX = 24 };
static const struct stage_source equation_sources[EQUATIONS] = {
    {"functions of vectors and numbers", text_prelude_glsl, .whole = true},
    {"a point of a surface, and the vectors around it", text_surface_h, .whole = true},
    {"reflection of the light from one direction at a point of a surface", text_lobes_h, .whole = true},
    {"kinds of light", text_light_kinds_h, .whole = true},
    {"light that arrives at a point: direction, distance, attenuation and cone", text_lights_h, .whole = true},
    {"light that leaves a point: its terms and their sum", text_sum_h, .whole = true},
    {"a point before lighting: its normal and tangent, and its material after maps", text_point_h, .whole = true},
    {"layers of physical materials", text_layer_kinds_h, .whole = true},
    {"light through the layers of a physical material", text_layers_h, .whole = true},
    {"refraction", text_refraction_h, .whole = true},
    {"the light of an environment around a point", text_surroundings_h, .whole = true},
    {"tone curves: from light to colours of a screen", text_tone_h, .whole = true}};

struct equations {
    struct stage_source sources[SOURCES_MAX];
    struct text texts[SOURCES_MAX];
    struct definition definitions[DEFINITIONS_MAX];
    struct source_span spans[DEFINITIONS_MAX];
    int source_count, count;
    struct definition_index index;
};

static void make_index(struct equations *w)
{
    memset(w->index.first, 0xff, sizeof w->index.first);
    for (int i = w->count - 1; i >= 0; i--) {
        int *first = &w->index.first[hash_of(w->definitions[i].name, w->definitions[i].name_length)];
        w->index.next[i] = *first;
        *first = i;
    }
}

// Marks the definitions that `main` needs, directly or indirectly. Returns the number of spans.
static int keep(struct equations *w)
{
    for (int i = 0; i < w->count; i++)
        w->definitions[i].kept = w->definitions[i].name_length == 4 && begins(w->definitions[i].name, "main");
    bool seen[DEFINITIONS_MAX] = {false};
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = w->count - 1; i >= 0; i--)
            if (w->definitions[i].kept && !seen[i]) {
                changed |= mark(w->definitions, &w->index, &w->definitions[i]);
                seen[i] = true;
            }
    }
    int count = 0;
    for (int i = 0; i < w->count; i++) {
        const struct definition *p = &w->definitions[i];
        if (p->kept)
            w->spans[count++] = (struct source_span){p->lead, p->start, p->end, !w->sources[p->file].whole};
    }
    return count;
}

static void write_title(struct text *text, const char *title)
{
    text_print(text, title ? "\n// --- %s\n\n" : "\n", title);
}

static void write_kept(struct text *text, const struct equations *w)
{
    int file = -1, next = 0;
    bool define = false, spaced = false;
    for (int i = 0; i <= w->count; i++) {
        const struct definition *p = i < w->count ? &w->definitions[i] : NULL;
        for (; next < (p ? p->file : w->source_count); next++)
            if (w->sources[next].made && w->sources[next].text) {
                if (w->sources[next].title)
                    write_title(text, w->sources[next].title);
                text_add(text, w->sources[next].text);
            }
        if (!p)
            return;
        spaced |= p->spaced;
        if (!p->kept)
            continue;
        if (p->file != file)
            write_title(text, w->sources[p->file].title);
        bool is_define = *p->start == '#', one_line = next_line(p->start) == p->end;
        if (p->file == file && (spaced || !p->file) && !(define && is_define && p->lead == p->start) &&
            !(p->file == 0 && one_line))
            text_add(text, "\n");
        file = p->file;
        define = is_define;
        spaced = false;
        write_definition(text, p);
    }
}

void equations_add(struct text *text, const struct stage_source *sources, int count, const struct constant *constants)
{
    struct equations *w = calloc(1, sizeof *w);
    bool ok = w != NULL;
    for (int i = 0; ok && i < EQUATIONS + count; i++) {
        struct text *to = &w->texts[i];
        w->sources[w->source_count++] = i < EQUATIONS ? equation_sources[i] : sources[i - EQUATIONS];
        if (w->sources[i].made || !w->sources[i].text)
            continue;
        specialize_branches(to, w->sources[i].text, constants);
        ok = !to->failed;
        if (ok && to->bytes)
            w->count = split_definitions(w->definitions, w->count, to->bytes, i);
    }
    if (ok) {
        make_index(w);
        while (specialize_unread(w->spans, keep(w)))
            ;
        write_kept(text, w);
    } else {
        text->failed = true;
        fail(&text->error, LAM_MACHINE, "out of memory");
    }
    for (int i = 0; w && i < w->source_count; i++)
        free(w->texts[i].bytes);
    free(w);
}
