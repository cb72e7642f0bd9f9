// equations.c: takes the texts of src/lighting apart, keeps what is called, and writes it as plain GLSL.
#include "equations.h"

#include "fail.h"
#include "sources.inc"

#include <stdlib.h>
#include <string.h>

// A piece of a file: a function, a struct, a #define, with the comment that leads it.
struct piece {
    const char *lead, *start, *end; // lead == start: no comment
    const char *name;
    size_t name_length;
    int file;
    bool kept;
};

enum { PIECES_MAX = 256, FILES = 4 };

static bool in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static const char *next_line(const char *at)
{
    at += strcspn(at, "\n");
    return *at ? at + 1 : at;
}

static bool begins(const char *at, const char *with) { return strncmp(at, with, strlen(with)) == 0; }

// The end of a definition: of its first line where that closes what it opens, else of the line that begins
// with the closing bracket.
static const char *definition_end(const char *at)
{
    const char *end = next_line(at), *last = end;
    while (last > at && (last[-1] == '\n' || last[-1] == ';'))
        last--;
    if (last > at && last[-1] == '}')
        return end;
    while (*at && *at != '}')
        at = next_line(at);
    return next_line(at);
}

static void name_piece(struct piece *piece)
{
    const char *at = piece->start;
    if (begins(at, "#define ")) {
        piece->name = at + 8;
    } else if (begins(at, "STRUCT(")) {
        piece->name = at + 7;
    } else {
        piece->name = strchr(at, '(');
        while (piece->name > at && in_name(piece->name[-1]))
            piece->name--;
    }
    while (in_name(piece->name[piece->name_length]))
        piece->name_length++;
}

// The lines that only give the dialect its words.
static bool is_scaffold(const char *at)
{
    static const char *const starts[] = {"#ifdef",        "#endif",           "precision",
                                         "#define FN\n",  "#define STRUCT",   "#define num ",
                                         "#define mask ", "#define vec3_of ", "#define vec4_of "};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (begins(at, starts[i]))
            return true;
    return begins(at, "float num_of(");
}

static int take_apart(struct piece *pieces, int count, const char *source, int file)
{
    const char *lead = NULL;
    for (const char *at = source; *at;) {
        const char *next = next_line(at);
        if (begins(at, "//")) {
            lead = lead ? lead : at;
        } else if (*at == '\n' || is_scaffold(at)) {
            lead = NULL;
        } else {
            struct piece *piece = &pieces[count];
            next = *at == '#' ? next : definition_end(at);
            *piece = (struct piece){.lead = lead ? lead : at, .start = at, .end = next, .file = file};
            name_piece(piece);
            lead = NULL;
            if (++count == PIECES_MAX)
                return count;
        }
        at = next;
    }
    return count;
}

// Marks what the words of a text name. True where something was not marked before.
static bool mark(struct piece *pieces, int count, const char *at, const char *end)
{
    bool changed = false;
    while (at < end) {
        if (at[0] == '/' && at[1] == '/') {
            at = next_line(at);
        } else if (!in_name(*at)) {
            at++;
        } else {
            size_t length = 1;
            while (at + length < end && in_name(at[length]))
                length++;
            for (int i = 0; i < count; i++) {
                struct piece *p = &pieces[i];
                if (!p->kept && p->name_length == length && memcmp(p->name, at, length) == 0)
                    p->kept = changed = true;
            }
            at += length;
        }
    }
    return changed;
}

// GLSL's own words for those of the dialect.
static const char *const renamed[][2] = {
    {"num_of", "float"}, {"num", "float"}, {"mask", "bool"}, {"vec3_of", "vec3"}, {"vec4_of", "vec4"}};

static void write_plain(struct text *text, const char *at, const char *end)
{
    bool comment = false;
    while (at < end) {
        if (*at == '\n')
            comment = false;
        else if (at[0] == '/' && at[1] == '/')
            comment = true;
        if (comment || !in_name(*at)) {
            text_add_part(text, at++, 1);
            continue;
        }
        size_t length = 1;
        while (at + length < end && in_name(at[length]))
            length++;
        if (length == 2 && begins(at, "FN ")) {
            at += 3;
            continue;
        }
        if (length == 6 && begins(at, "STRUCT(")) {
            size_t name = strcspn(at + 7, ")");
            text_add(text, "struct ");
            text_add_part(text, at + 7, name);
            at += 8 + name;
            continue;
        }
        // Numbers stand without C's f, and without a call round them.
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

void equations_add(struct text *text, const char *calls)
{
    static const char *const sources[FILES] = {text_prelude_glsl, text_lobes_h, text_sources_h, text_sum_h};
    static const char *const titles[FILES] = {
        "the words that the equations are written in",
        "how a point of a surface answers the light of one direction",
        "what of a light arrives at a point: its direction, distance, attenuation and cone",
        "the light that leaves a point, as terms and as their sum"};
    struct piece *pieces = malloc(PIECES_MAX * sizeof *pieces);
    if (!pieces) {
        text->failed = true;
        fail(&text->error, LAM_LIMIT, "out of memory");
        return;
    }
    int count = 0;
    for (int i = 0; i < FILES; i++)
        count = take_apart(pieces, count, sources[i], i);
    mark(pieces, count, calls, calls + strlen(calls));
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = 0; i < count; i++)
            if (pieces[i].kept)
                changed |= mark(pieces, count, pieces[i].start, pieces[i].end);
    }
    int file = -1;
    bool define = false;
    for (int i = 0; i < count; i++) {
        const struct piece *p = &pieces[i];
        if (!p->kept)
            continue;
        if (p->file != file)
            text_print(text, "\n// --- %s\n\n", titles[p->file]);
        bool is_define = *p->start == '#', one_line = next_line(p->start) == p->end;
        if (p->file == file && !(define && is_define && p->lead == p->start) && !(p->file == 0 && one_line))
            text_add(text, "\n");
        file = p->file;
        define = is_define;
        write_plain(text, p->lead, p->end);
    }
    free(pieces);
}
