// diagnostics.c: the compiler's words, and what is told of a shader's names.
#include "diagnostics.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "compiler_hints.h"

enum { NOTES_MOST = 64, LOG_LINES_MOST = 8 };

void diagnostics_add(struct diagnostics *notes, lam_check_note_kind kind, const char *file, int line,
                     const char *format, ...)
{
    char text[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (int i = 0; i < notes->count; i++) // said already
        if (notes->items[i].line == line && strcmp(notes->items[i].text, text) == 0)
            return;
    if (!notes->items)
        notes->items = arena_alloc(notes->arena, NOTES_MOST * sizeof *notes->items);
    char *kept = arena_string(notes->arena, text);
    if (!notes->items || !kept) {
        notes->failed = true;
        return;
    }
    if (notes->count < NOTES_MOST)
        notes->items[notes->count++] = (lam_check_note){.kind = kind, .file = file, .line = line, .text = kept};
}

// "0:12(5): error: …" (Mesa), "0(12) : error …" (NVIDIA), "ERROR: 0:12: …" (others): the line's number, and
// where the words begin. 0: none.
static int line_of(const char *text, const char **words)
{
    int string = 0, line = 0, used = 0;
    *words = text;
    const char *at = strncmp(text, "ERROR: ", 7) == 0 ? text + 7 : text;
    if ((sscanf(at, "%d:%d(%*d)%n", &string, &line, &used) >= 2 && used) ||
        (sscanf(at, "%d:%d%n", &string, &line, &used) >= 2 && used) ||
        (sscanf(at, "%d(%d)%n", &string, &line, &used) >= 2 && used)) {
        at += used;
        while (*at == ' ' || *at == ':')
            at++;
        *words = at;
        return line;
    }
    return 0;
}

void diagnostics_of_refusal(struct diagnostics *notes, const struct check_drawn *drawn,
                            const struct shader_interface *reading, const lam_check_params *params)
{
    bool vertex = drawn->state == DRAWN_REFUSED_VERTEX, link = drawn->state == DRAWN_REFUSED_LINK;
    const struct declarations *d = vertex ? &reading->vertex : &reading->fragment;
    const char *file = link ? NULL : vertex ? params->vertex_name : params->fragment_name;
    char log[sizeof drawn->log];
    snprintf(log, sizeof log, "%s", drawn->log);
    int told = 0;
    char *rest = log;
    for (char *line; (line = strsep(&rest, "\n")) && told < LOG_LINES_MOST;) {
        for (char *c = line; *c; c++)
            if (iscntrl((unsigned char)*c))
                *c = ' ';
        if (strspn(line, " ") == strlen(line))
            continue;
        const char *words;
        int at = line_of(line, &words);
        diagnostics_add(notes, LAM_CHECK_NOTE_COMPILER, file, at, "%.400s", words);
        told++;
        if (!link)
            compiler_hints_of_message(notes, d, file, at, words);
    }
    if (!told)
        diagnostics_add(notes, LAM_CHECK_NOTE_COMPILER, file, 0, "refused without a word");
    if (link)
        compiler_hints_of_link(notes, reading, params);
    else
        compiler_hints_of_text(notes, d, file, vertex);
}

static const char *file_of(const lam_check_params *params, bool vertex)
{
    return vertex ? params->vertex_name : params->fragment_name;
}

static void tell_unknown(struct diagnostics *notes, const struct shader_interface *r, const char *name,
                         const char *kind, const char *file, int line)
{
    const char *near = contract_nearest(r->contract, name);
    if (near)
        diagnostics_add(notes, LAM_CHECK_NOTE_UNKNOWN, file, line,
                        "%s '%.60s' is unknown to the contract %s; the nearest that it knows is '%s'", kind, name,
                        r->contract->name, near);
    else
        diagnostics_add(notes, LAM_CHECK_NOTE_UNKNOWN, file, line,
                        "%s '%.60s' is unknown to the contract %s and gets no value; `lambent check --list` has "
                        "its names",
                        kind, name, r->contract->name);
}

// Compared without case and underscores: matrix names and the like are declared with their types.
static void tell_types(struct diagnostics *notes, const struct shader_interface *r, const struct declaration *d,
                       const char *file)
{
    const struct contract_name *known = contract_find(r->contract, d->name, false, NULL);
    if (known && ((strncmp(known->type, "mat", 3) == 0) != (strncmp(d->type, "mat", 3) == 0) ||
                  (strncmp(known->type, "vec", 3) == 0) != (strncmp(d->type, "vec", 3) == 0)))
        diagnostics_add(notes, LAM_CHECK_NOTE_HINT, file, d->line, "uniform %s %s: write uniform %s %s", d->type,
                        d->name, known->type, d->name);
}

// Whether the driver keeps a declared name: "lights[].a" is "lights[0].a" to it, and a block's member "Block.a".
static bool is_active(const struct check_drawn *drawn, const char *declared)
{
    for (int i = 0; i < drawn->unknown_count; i++) {
        const char *a = drawn->unknown[i], *b = declared, *dot = strchr(a, '.');
        for (int k = 0; k < 2 && a; k++, a = dot ? dot + 1 : NULL) {
            const char *x = a;
            for (b = declared; *x && *x == *b; x++, b++)
                if (*x == '[')
                    x += strcspn(x, "]") - 1;
            if ((!*x || *x == '[') && (!*b || *b == '['))
                return true;
        }
    }
    return false;
}

void diagnostics_of_names(struct diagnostics *notes, const struct check_drawn *drawn, const struct shader_interface *r,
                          const lam_check_params *params)
{
    const struct declarations *sides[] = {&r->vertex, &r->fragment};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++) {
            const struct declaration *d = &sides[s]->items[i];
            const char *file = file_of(params, s == 0);
            bool attribute = s == 0 && d->kind == DECLARED_INPUT && params->vertex;
            if (d->kind != DECLARED_UNIFORM && !attribute)
                continue;
            if (!contract_find(r->contract, d->name, attribute, NULL)) {
                // One that nothing of the picture depends on does no harm.
                if (drawn->state != DRAWN_PICTURES || is_active(drawn, d->name))
                    tell_unknown(notes, r, d->name, attribute ? "attribute" : "uniform", file, d->line);
            } else if (!attribute)
                tell_types(notes, r, d, file);
        }
    for (int i = 0; i < drawn->unknown_count; i++) { // active, and not seen in the text (made by macros)
        bool seen = false;
        for (int s = 0; s < 2; s++)
            for (int k = 0; k < sides[s]->count; k++) {
                const char *name = sides[s]->items[k].name;
                size_t length = strcspn(name, "[");
                seen |= strncmp(name, drawn->unknown[i], length) == 0;
            }
        if (!seen)
            tell_unknown(notes, r, drawn->unknown[i], "uniform", NULL, 0);
    }
    for (int i = 0; i < drawn->types_count; i++)
        diagnostics_add(notes, LAM_CHECK_NOTE_HINT, NULL, 0, "%s; it gets no value", drawn->types[i]);
}
