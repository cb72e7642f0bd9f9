// specialize.c: removes branches with a known condition, and members that are never read, from the equations' text.
#include "specialize.h"

#include <string.h>

static const char *next_line(const char *at, const char *end)
{
    const char *line_end = memchr(at, '\n', (size_t)(end - at));
    return line_end ? line_end + 1 : end;
}

static size_t indent_of(const char *at) { return strspn(at, " "); }

// --- branches

// Returns the table's row for a line "if (…) {"; NULL for other lines and unknown conditions.
static const struct known_condition *look_up(const char *line, const char *end, const struct known_condition *known)
{
    line += indent_of(line);
    size_t length = (size_t)(end - line);
    if (length < 8 || memcmp(line, "if (", 4) != 0 || memcmp(end - 4, ") {\n", 4) != 0)
        return NULL;
    for (; known->condition; known++)
        if (strlen(known->condition) == length - 8 && memcmp(known->condition, line + 4, length - 8) == 0)
            return known;
    return NULL;
}

// Returns the next line that begins with a brace at column `indent`.
static const char *closing(const char *at, const char *end, size_t indent)
{
    while (at < end && !(indent_of(at) == indent && at[indent] == '}'))
        at = next_line(at, end);
    return at;
}

// Copies lines and resolves their branches; `shift` is the number of columns to remove from the indentation.
static void resolve(struct text *text, const char *at, const char *end, const struct known_condition *known,
                    size_t shift)
{
    while (at < end) {
        const char *next = next_line(at, end);
        size_t indent = indent_of(at);
        const struct known_condition *row = look_up(at, next, known);
        if (!row) {
            size_t off = indent < shift ? indent : shift;
            text_add_part(text, at + off, (size_t)(next - at) - off);
            at = next;
            continue;
        }
        const char *close = closing(next, end, indent), *after = next_line(close, end);
        bool has_else = (size_t)(after - close) > indent + 2 && close[indent + 1] == ' ';
        const char *last = has_else ? closing(after, end, indent) : close;
        if (row->holds)
            resolve(text, next, close, known, shift + 4);
        else if (has_else)
            resolve(text, after, last, known, shift + 4);
        at = next_line(last, end);
    }
}

void specialize_conditions(struct text *text, const char *source, const struct known_condition *known)
{
    resolve(text, source, source + strlen(source), known, 0);
}

// --- members

struct word {
    const char *at;
    size_t length;
};

static bool in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static struct word word_at(const char *at, const char *end)
{
    struct word word = {at, 0};
    while (at + word.length < end && in_name(at[word.length]))
        word.length++;
    return word;
}

static bool same(struct word a, struct word b) { return a.length == b.length && memcmp(a.at, b.at, a.length) == 0; }

// Returns the next word from `at` on, outside comments; its length is 0 at the end.
static struct word next_word(const char *at, const char *end)
{
    while (at < end && !in_name(*at))
        at = at[0] == '/' && at + 1 < end && at[1] == '/' ? next_line(at, end) : at + 1;
    return word_at(at, end);
}

// Whether a span declares a variable of a type: "TYPE VARIABLE".
static bool is_of(const struct source_span *s, struct word variable, struct word type)
{
    struct word before = {s->start, 0};
    for (struct word w = next_word(s->start, s->end); w.length; w = next_word(w.at + w.length, s->end)) {
        if (same(w, variable) && same(before, type) && w.at == before.at + before.length + 1)
            return true;
        before = w;
    }
    return false;
}

// Whether a line only assigns to a member: "variable.member = …;". Returns the line.
static bool only_sets(const struct source_span *s, const char *variable, struct word member, struct source_span *line)
{
    const char *start = variable, *end = next_line(variable, s->end), *after_member = member.at + member.length;
    while (start > s->start && start[-1] == ' ')
        start--;
    if ((start > s->start && start[-1] != '\n' && start[-1] != SPECIALIZE_ERASED) || end - after_member < 5 ||
        memcmp(after_member, " = ", 3) != 0 || memcmp(end - 2, ";\n", 2) != 0)
        return false;
    *line = (struct source_span){(char *)start, (char *)end};
    return true;
}

// Returns whether a span reads a struct's member. If none does, `erase` overwrites the lines that set the member.
static bool visit_uses(const struct source_span *s, struct word type, struct word member, bool erase)
{
    for (struct word w = next_word(s->start, s->end); w.length; w = next_word(w.at + w.length, s->end)) {
        if (!same(w, member) || w.at == s->start || w.at[-1] != '.')
            continue;
        const char *dot = w.at - 1, *variable = dot;
        while (variable > s->start && in_name(variable[-1]))
            variable--;
        if (variable == dot) { // of an array's element (no array holds structs of src/lighting), or of a call's result
            if (dot > s->start && dot[-1] == ']')
                continue;
            return true;
        }
        struct source_span line;
        if (!is_of(s, (struct word){variable, (size_t)(dot - variable)}, type))
            continue;
        if (!only_sets(s, variable, w, &line))
            return true;
        if (erase)
            memset(line.start, SPECIALIZE_ERASED, (size_t)(line.end - line.start));
    }
    return false;
}

static bool is_read(const struct source_span *spans, int count, struct word type, struct word member)
{
    for (int i = 0; i < count; i++)
        if (visit_uses(&spans[i], type, member, false))
            return true;
    return false;
}

bool specialize_members(const struct source_span *spans, int count)
{
    bool changed = false;
    for (int i = 0; i < count; i++) {
        const struct source_span *s = &spans[i];
        if (s->end - s->start < 8 || memcmp(s->start, "STRUCT(", 7) != 0)
            continue;
        struct word type = word_at(s->start + 7, s->end);
        int left = 0; // lines of members; the last one stays, because a GLSL struct cannot be empty
        for (const char *at = s->start; at < s->end; at = next_line(at, s->end))
            left += at[strspn(at, "\1")] == ' ';
        for (const char *at = s->start, *next; at < s->end; at = next) {
            while (at < s->end && *at == SPECIALIZE_ERASED)
                at++;
            next = next_line(at, s->end);
            if (at == s->end || *at != ' ') // a line with one member is "    TYPE NAME;"
                continue;
            struct word first = next_word(at, next), name = next_word(first.at + first.length, next);
            if (left == 1 || !name.length || name.at[name.length] != ';' || is_read(spans, count, type, name))
                continue;
            for (int k = 0; k < count; k++)
                visit_uses(&spans[k], type, name, true);
            memset((char *)at, SPECIALIZE_ERASED, (size_t)(next - at));
            changed = true;
            left--;
        }
    }
    return changed;
}
