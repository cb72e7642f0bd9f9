// shader_preprocess.c: selects the lines of a source by flags, and substitutes values.
#include "shader_preprocess.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

static void report(struct text *text, const char *what, const char *name, size_t length)
{
    if (!text->failed)
        fail(&text->error, LAM_BAD_ARGUMENT, "shader source: %s '%.*s'", what, (int)length, name);
    text->failed = true;
}

static bool flag_is_on(struct text *text, const struct preprocess_words *words, const char *name, size_t length)
{
    bool negated = length && *name == '!';
    name += negated;
    length -= negated;
    for (const struct preprocess_flag *f = words->flags; f && f->name; f++)
        if (strlen(f->name) == length && memcmp(f->name, name, length) == 0)
            return f->on != negated;
    report(text, "unknown flag", name, length);
    return false;
}

// Whether any flag of a line is on.
static bool any_flag(struct text *text, const struct preprocess_words *words, const char *at, const char *end)
{
    bool any = false;
    while (at < end) {
        size_t gap = strspn(at, " ");
        at += gap;
        size_t length = strcspn(at, " \n");
        if (at >= end || !length)
            break;
        any |= flag_is_on(text, words, at, length);
        at += length;
    }
    return any;
}

static const char *value_of(const struct preprocess_words *words, const char *name, size_t length)
{
    for (const struct preprocess_value *v = words->values; v && v->name; v++)
        if (strlen(v->name) == length && memcmp(v->name, name, length) == 0)
            return v->text;
    return NULL;
}

// Appends one line, with values substituted.
static void add_line(struct text *text, const char *at, const char *end, const struct preprocess_words *words)
{
    const char *const line = at;
    while (at < end) {
        if (*at == '@') {
            const char *close = memchr(at + 1, '@', (size_t)(end - at - 1));
            const char *value = close ? value_of(words, at + 1, (size_t)(close - at - 1)) : NULL;
            if (!value) {
                report(text, "unknown value", at, close ? (size_t)(close - at + 1) : 20);
                return;
            }
            text_add(text, value);
            bool alone = at == line && close[1] == '\n', ends = !*value || value[strlen(value) - 1] == '\n';
            at = alone && ends ? end : close + 1;
        } else if (at[0] == '$' && at[1] == '(') {
            const char *inner = at + 2, *close = memchr(inner, ')', (size_t)(end - inner));
            if (!close) {
                report(text, "missing ')' after", at, 20);
                return;
            }
            int length = (int)(close - inner);
            if (flag_is_on(text, words, "back_material", 13))
                text_print(text, "(front ? %.*s : back_%.*s)", length, inner, length, inner);
            else
                text_add_part(text, inner, (size_t)length);
            at = close + 1;
        } else {
            text_add_part(text, at++, 1);
        }
    }
}

enum { NESTING_MAX = 16 };

void preprocess_add(struct text *text, const char *source, const struct preprocess_words *words)
{
    // For each open //@if: whether lines are copied, and whether a branch has been taken.
    bool on[NESTING_MAX] = {true}, done[NESTING_MAX] = {false};
    int depth = 0;
    while (*source && !text->failed) {
        size_t length = strcspn(source, "\n");
        const char *end = source + length;
        if (strncmp(source, "//@if ", 6) == 0 && depth + 1 < NESTING_MAX) {
            bool is = any_flag(text, words, source + 6, end);
            depth++;
            on[depth] = on[depth - 1] && is;
            done[depth] = is;
        } else if (strncmp(source, "//@elif ", 8) == 0 && depth > 0) {
            bool is = any_flag(text, words, source + 8, end);
            on[depth] = on[depth - 1] && is && !done[depth];
            done[depth] |= is;
        } else if (strncmp(source, "//@else", 7) == 0 && depth > 0) {
            on[depth] = on[depth - 1] && !done[depth];
        } else if (strncmp(source, "//@end", 6) == 0 && depth > 0) {
            depth--;
        } else if (strncmp(source, "//@", 3) == 0) {
            report(text, "unknown directive", source, length);
        } else if (on[depth]) {
            add_line(text, source, *end ? end + 1 : end, words);
        }
        source = *end ? end + 1 : end;
    }
    if (depth)
        report(text, "missing //@end", "", 0);
}

// --- the tables

void preprocess_flag(struct preprocess_tables *t, const char *name, bool on)
{
    t->flags[t->flag_count++] = (struct preprocess_flag){name, on};
}

void preprocess_value(struct preprocess_tables *t, const char *name, const char *text)
{
    t->values[t->value_count++] = (struct preprocess_value){name, text};
}

struct text *preprocess_text(struct preprocess_tables *t, const char *name)
{
    preprocess_value(t, name, NULL);
    return &t->made[t->made_count++];
}

void preprocess_number(struct preprocess_tables *t, const char *name, int number)
{
    text_print(preprocess_text(t, name), "%d", number);
}

struct preprocess_words preprocess_finish(struct preprocess_tables *t, struct text *text)
{
    const struct text *from = t->made;
    for (int i = 0; i < t->value_count; i++) {
        if (t->values[i].text)
            continue;
        t->values[i].text = from->bytes ? from->bytes : "";
        if (from->failed && !text->failed) {
            text->failed = true;
            text->error = from->error;
        }
        from++;
    }
    return (struct preprocess_words){t->flags, t->values};
}

void preprocess_free(struct preprocess_tables *t)
{
    for (int i = 0; i < t->made_count; i++)
        free(t->made[i].bytes);
}
