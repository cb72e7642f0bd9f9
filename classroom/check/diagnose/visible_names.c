// visible_names.c: follows the braces of a shader and keeps the declarations of open blocks.
#include "diagnostics.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static bool is_identifier(const struct declarations *d, int i)
{
    return i >= 0 && i < d->word_count && word_is_name(d->words[i].text);
}

// Returns whether a word may precede a name without being the name's type.
static bool is_keyword(const struct declarations *d, int i)
{
    static const char *const words[] = {"return",    "else",      "do",      "in",        "out",    "inout", "uniform",
                                        "attribute", "const",     "varying", "flat",      "highp",  "lowp",  "mediump",
                                        "struct",    "precision", "smooth",  "invariant", "layout", "case",  "buffer"};
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        if (word_is(d, i, words[k]))
            return true;
    return false;
}

static void add(struct visible_names *out, const char *name, int depth)
{
    if (out->count == MAX_VISIBLE_NAMES) {
        memmove(out->names, out->names + 1, (MAX_VISIBLE_NAMES - 1) * sizeof *out->names);
        memmove(out->depths, out->depths + 1, (MAX_VISIBLE_NAMES - 1) * sizeof *out->depths);
        out->count--;
    }
    out->names[out->count] = name;
    out->depths[out->count++] = depth;
}

static void leave(struct visible_names *out, int depth)
{
    int kept = 0;
    for (int i = 0; i < out->count; i++)
        if (out->depths[i] <= depth) {
            out->names[kept] = out->names[i];
            out->depths[kept++] = out->depths[i];
        }
    out->count = kept;
}

void visible_names_at(const struct declarations *d, int at, bool functions, struct visible_names *out)
{
    int end = at < d->word_count ? at : d->word_count; // becomes the end of the last complete statement before `at`
    while (end > 0 && !word_is(d, end - 1, ";") && !word_is(d, end - 1, "{") && !word_is(d, end - 1, "}"))
        end--;
    int parentheses = 0;
    bool declares = false; // in the list of names of a declaration: float a, b;
    *out = (struct visible_names){.count = 0};
    for (int i = 0; i < end; i++) {
        const struct word *w = &d->words[i];
        parentheses += word_is(d, i, "(") - word_is(d, i, ")");
        bool parameter = w->depth == 0 && parentheses > 0;
        int depth = parameter ? 1 : w->depth; // parameters belong to the function's body
        if (word_is(d, i, "}") || (word_is(d, i, ";") && w->depth == 0))
            leave(out, w->depth);
        if (word_is(d, i, ";") || word_is(d, i, "{") || word_is(d, i, "}"))
            declares = false;
        if (!is_identifier(d, i) || is_keyword(d, i) || word_is(d, i, "main"))
            continue;
        // the instance name of a struct or a block
        bool instance = word_is(d, i - 1, "}") && (word_is(d, i + 1, ";") || word_is(d, i + 1, "["));
        bool typed = instance || (is_identifier(d, i - 1) && !is_keyword(d, i - 1) && !word_is(d, i - 2, "struct"));
        bool function = typed && word_is(d, i + 1, "(") && w->depth == 0;
        bool listed = declares && parentheses == 0 && word_is(d, i - 1, ",");
        declares = declares || (typed && !function && !parameter);
        if (functions ? function : (typed && !function) || listed)
            add(out, w->text, depth);
    }
}

// --- the list of messages in a report.

enum { MAX_DIAGNOSTICS = 64 };

void diagnostics_add(struct diagnostics *diagnostics, lam_check_diagnostic_kind kind, const char *file, int line,
                     const char *format, ...)
{
    char text[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (int i = 0; i < diagnostics->count; i++) // a duplicate
        if (diagnostics->items[i].line == line && strcmp(diagnostics->items[i].text, text) == 0)
            return;
    if (!diagnostics->items)
        diagnostics->items = arena_alloc(diagnostics->arena, MAX_DIAGNOSTICS * sizeof *diagnostics->items);
    char *kept = arena_string(diagnostics->arena, text);
    if (!diagnostics->items || !kept) {
        diagnostics->failed = true;
        return;
    }
    if (diagnostics->count < MAX_DIAGNOSTICS)
        diagnostics->items[diagnostics->count++] =
            (lam_check_diagnostic){.kind = kind, .file = file, .line = line, .text = kept};
}
