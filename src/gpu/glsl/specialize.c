// specialize.c: if the condition of a branch is known, keeps only the selected code. Then removes the names that are
// never read.
#include "glsl_text.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

struct span {
    const char *at, *end;
};

static const char *next_line(const char *at, const char *end)
{
    const char *line_end = memchr(at, '\n', (size_t)(end - at));
    return line_end ? line_end + 1 : end;
}

static size_t indent_of(const char *at) { return strspn(at, " "); }

static bool in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static bool begins(struct span s, const char *with)
{
    size_t length = strlen(with);
    return s.end - s.at >= (ptrdiff_t)length && memcmp(s.at, with, length) == 0;
}

static bool is(struct span s, const char *word) { return begins(s, word) && (size_t)(s.end - s.at) == strlen(word); }

static struct span name_at(const char *at, const char *end)
{
    struct span name = {at, at};
    while (name.end < end && in_name(*name.end))
        name.end++;
    return name;
}

static void add_span(struct text *text, struct span s) { text_add_part(text, s.at, (size_t)(s.end - s.at)); }

// --- expressions

enum { LENGTHS = 64 };
struct index {
    const struct constant *rows;
    bool any[LENGTHS][128]; // whether a name of that length begins with that character
};

static const char *text_of(struct span name, const struct index *constants)
{
    const size_t length = (size_t)(name.end - name.at);
    const struct constant *row = constants->rows;
    if (!length || length >= LENGTHS || !constants->any[length][*name.at & 127])
        return NULL;
    while (row->name && !is(name, row->name))
        row++;
    return row->text;
}

static bool is_truth(const char *text) { return strcmp(text, "true") == 0 || strcmp(text, "false") == 0; }

// Returns the bracket that closes the bracket at `at`.
static const char *closing_bracket(const char *at, const char *end)
{
    for (int depth = 0; at < end; at++) {
        depth += (*at == '(' || *at == '[') - (*at == ')' || *at == ']');
        if (!depth)
            break;
    }
    return at;
}

// Returns the first occurrence of an operator outside brackets, or NULL.
static const char *find_outside(struct span s, const char *operator)
{
    for (; s.at < s.end; s.at++) {
        if (begins(s, operator))
            return s.at;
        if (*s.at == '(' || *s.at == '[')
            s.at = closing_bracket(s.at, s.end);
    }
    return NULL;
}

// In ascending precedence. An operand of operator i decides the result if its value is !i.
static const char *const operators[] = {" || ", " && "};

// Returns 1 if the condition holds, 0 if it does not, and -1 if its value is unknown.
static int truth_of(struct span s, const struct index *constants)
{
    const char *text = text_of(s, constants);
    if (text)
        return is_truth(text) ? *text == 't' : -1;
    for (int i = 0; i < 2; i++) {
        const char *at = find_outside(s, operators[i]);
        if (!at)
            continue;
        int left = truth_of((struct span){s.at, at}, constants),
            right = truth_of((struct span){at + 4, s.end}, constants);
        return left == !i || right == !i ? !i : left < 0 || right < 0 ? -1 : i;
    }
    if (s.at < s.end && *s.at == '!') {
        int truth = truth_of((struct span){s.at + 1, s.end}, constants);
        return truth < 0 ? truth : !truth;
    }
    if (s.at < s.end && *s.at == '(' && closing_bracket(s.at, s.end) == s.end - 1)
        return truth_of((struct span){s.at + 1, s.end - 1}, constants);
    return -1;
}

static void add_expression(struct text *text, struct span s, const struct index *constants);

// Appends a bracket: expressions separated by commas. A group that contains a single choice loses its brackets if no
// operators remain.
static void add_bracket(struct text *text, struct span s, bool group, const struct index *constants)
{
    struct text inner = {0};
    struct span item = {s.at + 1, s.end - 1};
    group = group && (find_outside(item, " ? ") || find_outside(item, " || ") || find_outside(item, " && "));
    for (const char *comma; (comma = find_outside(item, ",")); item.at = comma + 1) {
        add_expression(&inner, (struct span){item.at, comma}, constants);
        text_add(&inner, ",");
    }
    add_expression(&inner, item, constants);
    group = group && !find_outside((struct span){inner.bytes, inner.bytes + inner.length}, " ");
    text_add_part(text, s.at, !group);
    text_add(text, inner.bytes ? inner.bytes : "");
    text_add_part(text, s.end - 1, !group);
    text->failed |= inner.failed;
    free(inner.bytes);
}

// Appends an operand: names, numbers, calls, brackets.
static void add_operand(struct text *text, struct span s, const struct index *constants)
{
    for (const char *start = s.at; s.at < s.end;) {
        struct span part = name_at(s.at, s.end);
        const char *other = s.at > start && s.at[-1] == '.' ? NULL : text_of(part, constants);
        if (*s.at == '(' || *s.at == '[') {
            part.end = closing_bracket(s.at, s.end) + 1;
            bool of_if = s.at - start > 2 && memcmp(s.at - 3, "if ", 3) == 0;
            add_bracket(text, part, *s.at == '(' && !of_if && (s.at == start || !in_name(s.at[-1])), constants);
        } else if (other && !is_truth(other)) {
            text_add(text, other);
        } else {
            part.end += part.end == part.at;
            add_span(text, part);
        }
        s.at = part.end;
    }
}

// Returns the colon that belongs to the question mark of a choice (?:).
static const char *colon_of(struct span s)
{
    for (int depth = 1;; s.at++) {
        const char *at = find_outside(s, " : "), *question = find_outside(s, " ? ");
        bool nested = question && question < at;
        depth += nested ? 1 : -1;
        s.at = nested ? question : at;
        if (!depth || !at)
            return at;
    }
}

static void add_expression(struct text *text, struct span s, const struct index *constants)
{
    for (; s.at < s.end && (*s.at == ' ' || *s.at == '\n'); s.at++)
        text_add_part(text, s.at, 1);
    const char *question = find_outside(s, " ? "),
               *colon = question ? colon_of((struct span){question + 3, s.end}) : NULL;
    if (colon) {
        struct span condition = {s.at, question}, yes = {question + 3, colon}, no = {colon + 3, s.end};
        int truth = truth_of(condition, constants);
        if (truth < 0) {
            add_expression(text, condition, constants);
            text_add(text, " ? ");
            add_expression(text, yes, constants);
            text_add(text, " : ");
        }
        add_expression(text, truth > 0 ? yes : no, constants);
        return;
    }
    for (int i = 0; i < 2; i++) {
        const char *at = find_outside(s, operators[i]);
        if (!at)
            continue;
        struct span left = {s.at, at}, right = {at + 4, s.end};
        bool keeps_left = truth_of(left, constants) != i, keeps_right = truth_of(right, constants) != i;
        if (keeps_left)
            add_expression(text, left, constants);
        text_add(text, keeps_left && keeps_right ? operators[i] : "");
        if (keeps_right)
            add_expression(text, right, constants);
        return;
    }
    add_operand(text, s, constants);
}

// --- lines

static bool has_constant(struct span s, const struct index *constants)
{
    for (const char *at = s.at; at < s.end; at++)
        if (in_name(*at)) {
            struct span name = name_at(at, s.end);
            if ((at == s.at || at[-1] != '.') && text_of(name, constants))
                return true;
            at = name.end - 1;
        }
    return false;
}

// Appends a statement, or the head of a statement, without its indentation.
static void add_statement(struct text *text, struct span s, const struct index *constants)
{
    struct span code = s;
    while (code.at < s.end && !begins(code, "//"))
        code.at++;
    code = (struct span){s.at, code.at};
    if (!has_constant(code, constants)) {
        add_span(text, s);
        return;
    }
    const char *equals = find_outside(code, "= "), *value = equals ? equals + 2 : code.at;
    value += begins(code, "return ") ? strlen("return ") : 0;
    const char *semicolon = find_outside((struct span){value, code.end}, ";"), *end = semicolon ? semicolon : code.end;
    add_operand(text, (struct span){code.at, value}, constants);
    add_expression(text, (struct span){value, end}, constants);
    add_span(text, (struct span){end, s.end});
}

// Returns the next line that begins with a brace at column `indent`.
static const char *closing(const char *at, const char *end, size_t indent)
{
    while (at < end && !(indent_of(at) == indent && at[indent] == '}'))
        at = next_line(at, end);
    return at;
}

static void add_lines(struct text *text, struct span s, const struct index *constants, size_t shift);

// Appends the selected branch of the `if` at `head`. Returns the position after the `if`, or NULL if the condition is
// unknown.
static const char *add_branch(struct text *text, const char *head, struct span s, const struct index *constants,
                              size_t shift)
{
    size_t indent = indent_of(head);
    for (head += indent;;) {
        const char *next = next_line(head, s.end);
        struct span line = {head, next};
        if (!begins(line, "if (") || next - head < 8 || memcmp(next - 4, ") {\n", 4) != 0)
            return NULL;
        int truth = truth_of((struct span){head + 4, next - 4}, constants);
        if (truth < 0)
            return NULL;
        const char *close = closing(next, s.end, indent);
        struct span after = {close + indent, s.end};
        if (truth)
            add_lines(text, (struct span){next, close}, constants, shift + 4);
        if (!truth && begins(after, "} else if (")) {
            head = after.at + 7;
            continue;
        }
        if (!truth && begins(after, "} else {")) {
            next = next_line(close, s.end);
            close = closing(next, s.end, indent);
            add_lines(text, (struct span){next, close}, constants, shift + 4);
        }
        while (begins((struct span){close + indent, s.end}, "} else"))
            close = closing(next_line(close, s.end), s.end, indent);
        return next_line(close, s.end);
    }
}

// Returns the end of the statement that begins with the line `at`. A statement continues while brackets are open, and
// includes all lines of a choice (?:).
static const char *statement_end(const char *at, const char *end)
{
    for (int open = 0; at < end;) {
        const char *next = next_line(at, end);
        for (; at < next; at++)
            open += (*at == '(' || *at == '[') - (*at == ')' || *at == ']');
        struct span more = {next + indent_of(next), end};
        if (open <= 0 && !begins(more, "? ") && !begins(more, ": "))
            break;
    }
    return at;
}

// Appends a statement of several lines as one line.
static void add_joined(struct text *text, struct span s, const struct index *constants)
{
    struct text joined = {0};
    for (const char *next; s.at < s.end; s.at = next + indent_of(next)) {
        next = next_line(s.at, s.end);
        text_add_part(&joined, s.at, (size_t)(next - s.at - 1));
        text_add(&joined, next < s.end ? " " : "\n");
    }
    add_statement(text, (struct span){joined.bytes, joined.bytes + joined.length}, constants);
    text->failed |= joined.failed;
    free(joined.bytes);
}

// Copies lines and resolves their branches; `shift` is the number of columns to remove from the indentation.
static void add_lines(struct text *text, struct span s, const struct index *constants, size_t shift)
{
    while (s.at < s.end) {
        const char *next = next_line(s.at, s.end), *after = add_branch(text, s.at, s, constants, shift);
        size_t indent = indent_of(s.at), off = indent < shift ? indent : shift;
        struct span line = {s.at + indent, next};
        const char *lines =
            next - line.at > 2 && next[-2] == ';' ? text_of((struct span){line.at, next - 2}, constants) : NULL;
        if (lines) {
            text_add(text, lines);
        } else if (!after) {
            text_add_part(text, s.at + off, indent - off);
            const struct span statement = {line.at, statement_end(line.at, s.end)};
            after = statement.end > next && has_constant(statement, constants) ? statement.end : NULL;
            if (after)
                add_joined(text, statement, constants);
            else
                add_statement(text, line, constants);
        }
        s.at = after ? after : next;
    }
}

void specialize_branches(struct text *text, const char *source, const struct constant *constants)
{
    struct index index = {.rows = constants};
    for (; constants->name; constants++)
        index.any[strlen(constants->name) % LENGTHS][*constants->name & 127] = true;
    add_lines(text, (struct span){source, source + strlen(source)}, &index, 0);
}

// --- unread names

// Returns the next name from `at` on, outside comments. At the end of the source, the name is empty.
static struct span next_name(const char *at, const char *end)
{
    while (at < end && !in_name(*at))
        at = at[0] == '/' && at + 1 < end && at[1] == '/' ? next_line(at, end) : at + 1;
    return name_at(at, end);
}

static bool same(struct span a, struct span b)
{
    return a.end - a.at == b.end - b.at && memcmp(a.at, b.at, (size_t)(a.end - a.at)) == 0;
}

static void erase(const char *from, const char *to) { memset((char *)from, SPECIALIZE_ERASED, (size_t)(to - from)); }

// Returns whether the code of a line ends with a semicolon.
static bool is_statement(const char *at, const char *end)
{
    while (at < end && *at != '\n' && !(*at == '/' && at[1] == '/'))
        at++;
    while (at[-1] == ' ')
        at--;
    return at[-1] == ';';
}

// Returns the line that begins with `first` if this line only sets the variable or member that ends at `after`.
// Otherwise, returns NULL.
static const char *setting_line(const struct source_span *s, const char *first, const char *after)
{
    while (first > s->start && first[-1] == ' ')
        first--;
    bool begins_line = first == s->start || first[-1] == '\n' || first[-1] == SPECIALIZE_ERASED;
    return begins_line && s->end - after > 4 && memcmp(after, " = ", 3) == 0 && is_statement(after, s->end) ? first
                                                                                                            : NULL;
}

// Returns whether a span declares a variable of a type: "TYPE VARIABLE".
static bool is_of(const struct source_span *s, struct span variable, struct span type)
{
    struct span before = {s->start, s->start};
    for (struct span w = next_name(s->start, s->end); w.end > w.at; w = next_name(w.end, s->end)) {
        if (same(w, variable) && same(before, type) && w.at == before.end + 1)
            return true;
        before = w;
    }
    return false;
}

// Returns whether a span reads a struct's member. If the member is not read and `erases` is set, overwrites the lines
// that set the member.
static bool reads_member(const struct source_span *s, struct span type, struct span member, bool erases)
{
    for (struct span w = next_name(s->start, s->end); w.end > w.at; w = next_name(w.end, s->end)) {
        if (!same(w, member) || w.at == s->start || w.at[-1] != '.')
            continue;
        struct span variable = {w.at - 1, w.at - 1};
        while (variable.at > s->start && in_name(variable.at[-1]))
            variable.at--;
        bool element = variable.at == variable.end && variable.at > s->start && variable.at[-1] == ']';
        if (element) // an array element; no array contains structs of src/core/lighting
            continue;
        if (variable.at == variable.end) // the result of a call
            return true;
        if (!is_of(s, variable, type))
            continue;
        const char *line = setting_line(s, variable.at, w.end);
        if (!line)
            return true;
        if (erases)
            erase(line, next_line(line, s->end));
    }
    return false;
}

static bool is_struct(const struct source_span *s) { return begins((struct span){s->start, s->end}, "struct "); }

static bool erase_members(const struct source_span *spans, int count, const struct source_span *s)
{
    bool changed = false;
    struct span type = name_at(s->start + 7, s->end);
    int left = 0; // lines with members; one line is always kept, because a GLSL struct cannot be empty
    for (const char *at = s->start; at < s->end; at = next_line(at, s->end))
        left += at[strspn(at, "\1")] == ' ';
    for (const char *at = s->start, *next; at < s->end; at = next) {
        at += strspn(at, "\1");
        next = next_line(at, s->end);
        if (at >= s->end || *at != ' ') // a line with one member is "    TYPE NAME;"
            continue;
        struct span name = next_name(next_name(at, next).end, next);
        bool read = left == 1 || name.end == name.at || *name.end != ';';
        for (int k = 0; k < count && !read; k++)
            read = reads_member(&spans[k], type, name, false);
        for (int k = 0; k < count && !read; k++)
            reads_member(&spans[k], type, name, true);
        if (read)
            continue;
        erase(at, next);
        changed = true;
        left--;
    }
    return changed;
}

// Returns whether a function reads a variable after `from`. If the variable is not read and `erases` is set, overwrites
// the lines that set the variable.
static bool reads(const struct source_span *s, const char *from, struct span name, bool erases)
{
    for (struct span w = next_name(from, s->end); w.end > w.at; w = next_name(w.end, s->end)) {
        if (!same(w, name) || w.at[-1] == '.')
            continue;
        const char *after = w.end;
        while (*after == '.')
            after = name_at(after + 1, s->end).end;
        const char *line = setting_line(s, w.at, after);
        if (!line)
            return true;
        w.end = next_line(w.at, s->end) - 1; // the line only reads names to set the variable
        if (erases)
            erase(line, w.end + 1);
    }
    return false;
}

static bool is_mentioned(const struct source_span *s, const char *from, struct span name)
{
    struct span w = next_name(from, s->end);
    while (w.end > w.at && !(same(w, name) && w.at[-1] != '.'))
        w = next_name(w.end, s->end);
    return w.end > w.at;
}

// Erases unread variables, and each `if` without statements.
static bool erase_variables(const struct source_span *s)
{
    bool changed = false;
    for (const char *at = next_line(s->start, s->end), *next; at < s->end; at = next) {
        at += strspn(at, "\1");
        next = next_line(at, s->end);
        size_t indent = indent_of(at);
        struct span type = name_at(at + indent, next), name = name_at(type.end + (type.end < next), next);
        const char *block = next + strspn(next, "\1"), *end = next;
        bool unread = indent && name.end > name.at && *type.end == ' ' && !is(type, "return") &&
                      is_statement(name.at, next) && (*name.end == ';' || memcmp(name.end, " = ", 3) == 0) &&
                      !reads(s, next, name, false);
        if (unread)
            reads(s, next, name, true);
        else if (is(type, "if") && next[-2] == '{' && indent_of(block) == indent &&
                 memcmp(block + indent, "}\n", 2) == 0)
            end = next_line(block, s->end);
        else
            continue;
        erase(at, end);
        changed = true;
    }
    return changed;
}

// Erases item i of a list between brackets.
static void erase_item(const char *open, const char *close, int i)
{
    struct span rest = {open + 1, close};
    const char *before = open, *comma = find_outside(rest, ",");
    for (; i > 0 && comma; i--) {
        before = comma;
        rest.at = comma + 1;
        comma = find_outside(rest, ",");
    }
    if (!comma)
        erase(before == open ? open + 1 : before, close);
    else
        erase(rest.at, comma + 1 + (before == open ? strspn(comma + 1, " \n") : 0));
}

// Erases the lines "// `NAME` ..." of a function's comment.
static void erase_comment(const struct source_span *function, struct span name)
{
    for (const char *at = function->lead, *next; at < function->start; at = next) {
        at += strspn(at, "\1");
        next = next_line(at, function->start);
        struct span line = {at, next};
        if (begins(line, "// `") && same(name_at(at + 4, next), name))
            erase(at, next);
    }
}

static void erase_arguments(const struct source_span *s, struct span called, int i)
{
    for (struct span w = next_name(s->start, s->end); w.end > w.at; w = next_name(w.end, s->end))
        if (same(w, called) && w.at != called.at && *w.end == '(')
            erase_item(w.end, closing_bracket(w.end, s->end), i);
}

static bool erase_parameters(const struct source_span *spans, int count, const struct source_span *function)
{
    const char *open =
        memchr(function->start, '(', (size_t)(next_line(function->start, function->end) - function->start));
    const char *close = open ? closing_bracket(open, function->end) : NULL;
    struct span called = {open, open};
    while (open && called.at > function->start && in_name(called.at[-1]))
        called.at--;
    if (!open || called.at == function->start || (close[1] != '\n' && memcmp(close + 1, " {", 2) != 0)) // a variable
        return false;
    bool changed = false;
    struct span rest = {open + 1, close};
    for (int i = 0; rest.at < close; i++) {
        const char *comma = find_outside(rest, ",");
        struct span item = {rest.at + strspn(rest.at, " \1"), comma ? comma : close};
        rest.at = comma ? comma + 1 : close;
        while (item.end > item.at && item.end[-1] == SPECIALIZE_ERASED)
            item.end--;
        struct span name = {item.end, item.end};
        while (name.at > item.at && in_name(name.at[-1]))
            name.at--;
        if (name.at == name.end || is(name, "void") || reads(function, close, name, false) ||
            (begins(item, "out ") && is_mentioned(function, close, name)))
            continue;
        reads(function, close, name, true);
        erase_comment(function, name);
        for (int k = 0; k < count; k++)
            erase_arguments(&spans[k], called, i);
        erase_item(open, close, i--);
        changed = true;
    }
    return changed;
}

bool specialize_unread(const struct source_span *spans, int count)
{
    bool changed = false;
    for (int i = 0; i < count; i++)
        if (spans[i].reduced && !is_struct(&spans[i])) {
            while (erase_variables(&spans[i]))
                changed = true;
            changed |= erase_parameters(spans, count, &spans[i]);
        }
    for (int i = 0; i < count && !changed; i++)
        changed |= is_struct(&spans[i]) && erase_members(spans, count, &spans[i]);
    return changed;
}
