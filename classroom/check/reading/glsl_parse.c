// glsl_parse.c: parses the words of a shader into a tree of typed nodes.
//
// The file is longer than 600 lines because the grammar is one set of functions that call each other.
#include "glsl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

enum { MAX_DEPTH = 120, MAX_PARSED = 30000, MAX_MEMORY = 1 << 15 };
static const struct glsl_type type_float = {GLSL_FLOAT, 1, 1, 0, 0}, type_bool = {GLSL_BOOL, 1, 1, 0, 0},
                              type_int = {GLSL_INT, 1, 1, 0, 0}, type_void = {GLSL_VOID, 1, 1, 0, 0};
static int expression(struct glsl_program *p);
static int assignment(struct glsl_program *p);
static int statement(struct glsl_program *p);

// --- words

static bool is(const struct glsl_program *p, const char *text) { return word_is(p->text, p->at, text); }
static const char *word(const struct glsl_program *p)
{
    const struct word *w = p->at < p->text->word_count ? &p->text->words[p->at] : NULL;
    return !w ? "" : w->number[0] ? w->number : w->text;
}

static int stop(struct glsl_program *p, const char *reason)
{
    if (!p->unsupported[0])
        snprintf(p->unsupported, sizeof p->unsupported, "line %d: %.60s",
                 p->at < p->text->word_count ? p->text->words[p->at].line : 0, reason);
    p->at = p->text->word_count;
    return 0;
}

static bool take(struct glsl_program *p, const char *text)
{
    bool found = is(p, text);
    p->at += found;
    return found;
}

static void expect(struct glsl_program *p, const char *text)
{
    if (!take(p, text))
        stop(p, text);
}

// --- nodes, types and variables

static int reserve(struct glsl_program *p, int size)
{
    int at = p->used;
    if (size < 0 || size > MAX_MEMORY || at + size > MAX_MEMORY)
        return stop(p, "too many variables");
    p->used += size;
    return at;
}

static int add(struct glsl_program *p, enum glsl_kind kind, int op, struct glsl_type type, int begin)
{
    if (p->node_count >= p->node_capacity)
        return stop(p, "too long");
    int at = kind == GLSL_VARIABLE ? 0 : reserve(p, glsl_size(p, type));
    p->nodes[p->node_count] = (struct glsl_node){.kind = (uint8_t)kind,
                                                 .op = (uint8_t)op,
                                                 .type = type,
                                                 .first = -1,
                                                 .next = -1,
                                                 .at = at,
                                                 .word = begin,
                                                 .end = p->at};
    return p->node_count++;
}

static void append(struct glsl_program *p, int parent, int child)
{
    int *last = &p->nodes[parent].first;
    if (p->unsupported[0])
        return;
    while (*last >= 0)
        last = &p->nodes[*last].next;
    *last = child;
    p->nodes[parent].end = p->at;
}

static int with(struct glsl_program *p, enum glsl_kind kind, int op, struct glsl_type type, int begin, int a, int b)
{
    int node = add(p, kind, op, type, begin);
    if (p->unsupported[0])
        return 0;
    append(p, node, a);
    if (b >= 0)
        append(p, node, b);
    return node;
}

static bool type_named(const struct glsl_program *p, const char *name, struct glsl_type *out)
{
    static const char letters[] = "\0bi"; // of bvec and ivec, by glsl_base
    *out = type_float;
    for (int i = p->structure_count - 1; i >= 0; i--)
        if (strcmp(p->structures[i].name, name) == 0) {
            *out = (struct glsl_type){GLSL_STRUCT, 1, 1, (uint8_t)i, 0};
            return true;
        }
    if (strcmp(name, "float") == 0 || strcmp(name, "double") == 0)
        return true;
    if (strcmp(name, "void") == 0)
        return *out = type_void, true;
    if (strcmp(name, "int") == 0 || strcmp(name, "uint") == 0)
        return *out = type_int, true;
    if (strcmp(name, "bool") == 0)
        return *out = type_bool, true;
    if (strncmp(name, "sampler", 7) == 0)
        return *out = (struct glsl_type){GLSL_SAMPLER, 1, 4, 0, 0}, true;
    const char *vector = strchr("biud", name[0]) && name[0] ? name + 1 : name;
    size_t length = strlen(name);
    if (strncmp(vector, "vec", 3) == 0 && strlen(vector) == 4 && strchr("234", vector[3])) {
        out->base = vector == name          ? GLSL_FLOAT
                    : name[0] == letters[1] ? GLSL_BOOL
                    : name[0] == 'd'        ? GLSL_FLOAT
                                            : GLSL_INT;
        out->rows = (uint8_t)(vector[3] - '0');
        return true;
    }
    if (strncmp(name, "mat", 3) != 0 || (length != 4 && length != 6) || !strchr("234", name[3]))
        return false;
    out->columns = out->rows = (uint8_t)(name[3] - '0');
    if (length == 6)
        out->rows = (uint8_t)(name[5] - '0');
    return length == 4 || (name[4] == 'x' && out->rows >= 2 && out->rows <= 4);
}

static struct glsl_symbol *find(struct glsl_program *p, const char *name)
{
    for (int i = p->symbol_count - 1; i >= 0; i--)
        if (strcmp(p->symbols[i].name, name) == 0)
            return &p->symbols[i];
    return NULL;
}

const struct glsl_symbol *glsl_symbol(const struct glsl_program *p, const char *name)
{
    return find((struct glsl_program *)(uintptr_t)p, name);
}

static struct glsl_symbol *declare(struct glsl_program *p, const char *name, struct glsl_type type, int storage)
{
    if (p->symbol_count == GLSL_SYMBOLS || strlen(name) > 63) {
        stop(p, "too many names");
        return &p->symbols[0];
    }
    struct glsl_symbol *s = &p->symbols[p->symbol_count++];
    *s = (struct glsl_symbol){.type = type, .storage = (uint8_t)storage, .at = reserve(p, glsl_size(p, type))};
    snprintf(s->name, sizeof s->name, "%s", name);
    return s;
}

static struct glsl_type skip_type(struct glsl_program *p)
{
    struct glsl_type t = type_float;
    while (is(p, "highp") || is(p, "mediump") || is(p, "lowp") || is(p, "const"))
        p->at++;
    if (!type_named(p, word(p), &t))
        stop(p, word(p));
    p->at++;
    return t;
}

// Parses [size], which may be empty if `size` receives the number later.
static void array_size(struct glsl_program *p, struct glsl_type *t, bool *open)
{
    if (!take(p, "["))
        return;
    if (take(p, "]")) {
        *open = true;
        return;
    }
    int node = expression(p);
    expect(p, "]");
    p->steps = 1000;
    double count = p->unsupported[0] ? 0 : *glsl_value(p, node);
    if (!(count >= 1 && count <= 4096) || t->count)
        stop(p, "size of an array");
    else
        t->count = (uint16_t)count;
}

// --- expressions

static int arguments(struct glsl_program *p, int node, struct glsl_type *types, int limit)
{
    int count = 0;
    while (!is(p, ")") && !p->unsupported[0]) {
        int argument = assignment(p);
        if (count < limit)
            types[count] = p->nodes[argument].type;
        count++;
        append(p, node, argument);
        if (!take(p, ","))
            break;
    }
    expect(p, ")");
    p->nodes[node].end = p->at;
    return count;
}

static bool accepts(struct glsl_type wanted, struct glsl_type given)
{
    return wanted.columns == given.columns && wanted.rows == given.rows && wanted.count == given.count &&
           (wanted.base == given.base || (wanted.base == GLSL_FLOAT && given.base == GLSL_INT)) &&
           (wanted.base != GLSL_STRUCT || wanted.structure == given.structure);
}

static int call(struct glsl_program *p)
{
    const char *name = word(p);
    struct glsl_type type, types[GLSL_PARAMETERS] = {{0}};
    const int begin = p->at;
    bool open = false;
    p->at++;
    if (strcmp(name, "ftransform") == 0 && is(p, "(") && word_is(p->text, p->at + 1, ")")) {
        const struct glsl_symbol *m = find(p, "gl_ModelViewProjectionMatrix"), *v = find(p, "gl_Vertex");
        p->at += 2;
        int a = add(p, GLSL_VARIABLE, 0, m->type, begin), b = add(p, GLSL_VARIABLE, 0, v->type, begin);
        p->nodes[a].at = m->at;
        p->nodes[b].at = v->at;
        return with(p, GLSL_BINARY, '*', v->type, begin, a, b);
    }
    if (type_named(p, name, &type)) {
        array_size(p, &type, &open);
        expect(p, "(");
        const int sized = p->at;
        int node = add(p, GLSL_CONSTRUCT, 0, type, begin), count = arguments(p, node, types, GLSL_PARAMETERS);
        if (open && count < 4096) {
            p->nodes[node].type.count = (uint16_t)count;
            p->nodes[node].at = reserve(p, glsl_size(p, p->nodes[node].type));
        }
        return count && sized ? node : stop(p, name);
    }
    expect(p, "(");
    int node = add(p, GLSL_CALL, 0, type_void, begin), count = arguments(p, node, types, GLSL_PARAMETERS);
    if (p->unsupported[0])
        return 0;
    for (int i = p->function_count - 1; i >= 0; i--) {
        bool same = strcmp(p->functions[i].name, name) == 0 && p->functions[i].count == count;
        for (int k = 0; k < count && same; k++)
            same = accepts(p->functions[i].types[k], types[k]);
        if (same && p->inner && p->functions[i].body < 0)
            return stop(p, name); // a function may call only functions above it, which excludes recursion
        if (same) {
            p->nodes[node].number = i;
            p->nodes[node].type = p->functions[i].type;
            p->nodes[node].at = reserve(p, glsl_size(p, p->functions[i].type));
            return node;
        }
    }
    int function = glsl_builtin(name);
    if (function < 0 || count > 4)
        return stop(p, name);
    p->nodes[node].kind = GLSL_BUILTIN;
    p->nodes[node].number = function;
    p->nodes[node].type = glsl_builtin_type(function, types, count);
    p->nodes[node].at = reserve(p, glsl_size(p, p->nodes[node].type));
    return node;
}

static int primary(struct glsl_program *p)
{
    const int begin = p->at;
    const char *text = word(p);
    double number;
    int node;
    if (take(p, "(")) {
        node = expression(p);
        expect(p, ")");
        p->nodes[node].word = begin;
        p->nodes[node].end = p->at;
        return node;
    }
    if (strchr("0123456789.", text[0]) && text[0]) {
        size_t length = strlen(text), digits = strcspn(text, strncmp(text, "0x", 2) == 0 ? "" : "fFuUlL");
        bool whole = !strpbrk(text, ".eEfF");
        if (number_double((const uint8_t *)text, (const uint8_t *)text + digits, &number) !=
            (const uint8_t *)text + digits) {
            char *end;
            number = (double)strtol(text, &end, 0);
            if (*end && length)
                return stop(p, text);
        }
        p->at++;
        node = add(p, GLSL_CONSTANT, 0, whole ? type_int : type_float, begin);
        p->memory[p->nodes[node].at] = number;
        return node;
    }
    if (strcmp(text, "true") == 0 || strcmp(text, "false") == 0) {
        p->at++;
        node = add(p, GLSL_CONSTANT, 0, type_bool, begin);
        p->memory[p->nodes[node].at] = text[0] == 't';
        return node;
    }
    if (!word_is_name(text))
        return stop(p, text);
    if (word_is(p->text, p->at + 1, "(") || word_is(p->text, p->at + 2, "]")) {
        struct glsl_type type;
        if (word_is(p->text, p->at + 1, "(") || type_named(p, text, &type))
            return call(p);
    }
    const struct glsl_symbol *s = find(p, text);
    if (!s) {
        struct glsl_type type;
        return type_named(p, text, &type) ? call(p) : stop(p, text);
    }
    p->at++;
    node = add(p, GLSL_VARIABLE, 0, s->type, begin);
    p->nodes[node].at = s->at;
    p->nodes[node].number = s->storage;
    return node;
}

// Parses .member or .xyz after the expression `node`.
static int part(struct glsl_program *p, int node)
{
    static const char sets[] = "xyzwrgbastpq";
    const struct glsl_type t = p->nodes[node].type;
    const char *name = word(p);
    const int begin = p->nodes[node].word;
    p->at++;
    if (t.count && strcmp(name, "length") == 0) {
        expect(p, "(");
        expect(p, ")");
        node = add(p, GLSL_CONSTANT, 0, type_int, begin);
        p->memory[p->nodes[node].at] = t.count;
        return node;
    }
    if (t.base == GLSL_STRUCT && !t.count) {
        const struct glsl_structure *s = &p->structures[t.structure];
        for (int i = s->first; i < s->first + s->count; i++)
            if (strcmp(p->members[i].name, name) == 0) {
                int member = with(p, GLSL_MEMBER, 0, p->members[i].type, begin, node, -1);
                p->nodes[member].number = p->members[i].offset;
                return member;
            }
        return stop(p, name);
    }
    size_t length = strlen(name);
    if (t.count || t.columns > 1 || t.base == GLSL_STRUCT || length > 4 || !length)
        return stop(p, name);
    struct glsl_type out = {t.base, 1, (uint8_t)length, 0, 0};
    int number = 0;
    for (size_t i = 0; i < length; i++) {
        const char *c = strchr(sets, name[i]);
        if (!c || (c - sets) % 4 >= t.rows)
            return stop(p, name);
        number |= (int)((c - sets) % 4) << (2 * i);
    }
    int swizzle = with(p, GLSL_SWIZZLE, 0, out, begin, node, -1);
    p->nodes[swizzle].number = number;
    return swizzle;
}

static int postfix(struct glsl_program *p)
{
    int node = primary(p);
    while (!p->unsupported[0]) {
        const struct glsl_type t = p->nodes[node].type;
        const int begin = p->nodes[node].word;
        if (take(p, ".")) {
            node = part(p, node);
        } else if (take(p, "[")) {
            struct glsl_type one = t;
            one.count = 0;
            if (!t.count && t.columns > 1)
                one.columns = 1;
            else if (!t.count)
                one.rows = 1;
            int index = expression(p);
            expect(p, "]");
            node = with(p, GLSL_INDEX, 0, one, begin, node, index);
        } else if ((is(p, "+") || is(p, "-")) && word_is(p->text, p->at + 1, word(p)) &&
                   strchr(";),", p->at + 2 < p->text->word_count ? p->text->words[p->at + 2].text[0] : ';')) {
            int op = word(p)[0];
            p->at += 2;
            node = with(p, GLSL_INCREMENT, op, t, begin, node, -1);
            p->nodes[node].number = 1;
        } else
            break;
    }
    return node;
}

static int unary(struct glsl_program *p)
{
    const int begin = p->at;
    const char op = word(p)[0];
    if (p->depth > MAX_DEPTH)
        return stop(p, "too deeply nested");
    if (strlen(word(p)) != 1 || !strchr("-+!", op))
        return postfix(p);
    p->depth++;
    p->at++;
    bool twice = op != '!' && word(p)[0] == op &&
                 word_is_name(p->at + 1 < p->text->word_count ? p->text->words[p->at + 1].text : "");
    p->at += twice;
    int operand = unary(p);
    p->depth--;
    if (p->unsupported[0])
        return 0;
    return with(p, twice ? GLSL_INCREMENT : GLSL_UNARY, op, op == '!' ? type_bool : p->nodes[operand].type, begin,
                operand, -1);
}

// Returns the operator at the current word, its precedence, and the number of its words. 0 means no binary operator.
static int operator_at(const struct glsl_program *p, int *precedence, int *words)
{
    static const struct {
        const char *text;
        int op, precedence;
    } rows[] = {{"<=", OP_LESS_EQUAL, 8},
                {">=", OP_GREATER_EQUAL, 8},
                {"==", OP_EQUAL, 7},
                {"!=", OP_NOT_EQUAL, 7},
                {"&&", OP_AND, 3},
                {"||", OP_OR, 1},
                {"^^", OP_XOR, 2},
                {"<<", OP_LEFT, 9},
                {">>", OP_RIGHT, 9},
                {"+", '+', 10},
                {"-", '-', 10},
                {"*", '*', 11},
                {"/", '/', 11},
                {"%", '%', 11},
                {"<", '<', 8},
                {">", '>', 8},
                {"&", '&', 6},
                {"^", '^', 5},
                {"|", '|', 4}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char one[2] = {rows[i].text[0], 0}, two[2] = {rows[i].text[1], 0};
        if (!is(p, one) || (two[0] && !word_is(p->text, p->at + 1, two)))
            continue;
        *words = two[0] ? 2 : 1;
        *precedence = rows[i].precedence;
        return word_is(p->text, p->at + *words, "=") && rows[i].op > OP_OR && *precedence != 8 ? 0 : rows[i].op;
    }
    return 0;
}

static struct glsl_type binary_type(int op, struct glsl_type a, struct glsl_type b)
{
    struct glsl_type t = glsl_width(b) > glsl_width(a) ? b : a;
    if (strchr("<>", op) || (op >= OP_LESS_EQUAL && op <= OP_XOR))
        return type_bool;
    if (op == '*' && a.columns > 1 && b.columns > 1)
        t = (struct glsl_type){GLSL_FLOAT, b.columns, a.rows, 0, 0};
    else if (op == '*' && a.columns > 1 && b.rows > 1)
        t = (struct glsl_type){GLSL_FLOAT, 1, a.rows, 0, 0};
    else if (op == '*' && a.rows > 1 && b.columns > 1)
        t = (struct glsl_type){GLSL_FLOAT, 1, b.columns, 0, 0};
    t.base = a.base == GLSL_FLOAT || b.base == GLSL_FLOAT ? GLSL_FLOAT : t.base;
    return t;
}

static bool fits(int op, struct glsl_type a, struct glsl_type b)
{
    if (a.count || b.count || a.base == GLSL_STRUCT || b.base == GLSL_STRUCT)
        return op == OP_EQUAL || op == OP_NOT_EQUAL;
    if (glsl_width(a) == 1 || glsl_width(b) == 1)
        return true;
    if (op == '*' && (a.columns > 1 || b.columns > 1))
        return (a.columns > 1 ? a.columns : a.rows) == b.rows;
    return a.columns == b.columns && a.rows == b.rows;
}

static int operation(struct glsl_program *p, int least)
{
    int left = unary(p), precedence, words, op;
    while (!p->unsupported[0] && (op = operator_at(p, &precedence, &words)) != 0 && precedence >= least) {
        p->at += words;
        p->depth++;
        int right = operation(p, precedence + 1);
        p->depth--;
        if (p->unsupported[0])
            return 0;
        const struct glsl_type a = p->nodes[left].type, b = p->nodes[right].type;
        if (!fits(op, a, b))
            return stop(p, "operands");
        left = with(p, GLSL_BINARY, op, binary_type(op, a, b), p->nodes[left].word, left, right);
    }
    return left;
}

static int assignment(struct glsl_program *p)
{
    if (p->depth++ > MAX_DEPTH)
        return stop(p, "too deeply nested");
    int node = operation(p, 1);
    const int begin = p->unsupported[0] ? 0 : p->nodes[node].word;
    const char op = word(p)[0];
    if (take(p, "?")) {
        int yes = expression(p);
        expect(p, ":");
        int no = assignment(p);
        if (!p->unsupported[0]) {
            node = with(p, GLSL_CHOICE, 0, p->nodes[yes].type, begin, node, yes);
            append(p, node, no);
        }
    } else if (is(p, "=") || (op && strchr("+-*/%&|^", op) && word_is(p->text, p->at + 1, "="))) {
        p->at += op == '=' ? 1 : 2;
        int value = assignment(p);
        if (!p->unsupported[0])
            node = with(p, GLSL_ASSIGN, op, p->nodes[node].type, begin, node, value);
    }
    p->depth--;
    return p->unsupported[0] ? 0 : node;
}

static int expression(struct glsl_program *p)
{
    int node = assignment(p);
    while (!p->unsupported[0] && take(p, ",")) { // the comma operator: the last value
        int block = with(p, GLSL_BINARY, OP_XOR, type_bool, p->at, node, assignment(p));
        node = block;
    }
    return node;
}

// --- declarations

// Parses the names after a type. Local variables become assignments, appended to `block`.
static void names(struct glsl_program *p, struct glsl_type base, struct glsl_symbol kind, int block)
{
    do {
        const int begin = p->at;
        const char *name = word(p);
        struct glsl_type t = base;
        bool open = false;
        p->at++;
        array_size(p, &t, &open);
        int value = -1;
        if (take(p, "=")) {
            value = assignment(p);
            t.count = open && !p->unsupported[0] ? p->nodes[value].type.count : t.count;
        } else if (open)
            stop(p, "an array without a size");
        if (p->unsupported[0])
            return;
        struct glsl_symbol *s = declare(p, name, t, kind.storage);
        s->flat = kind.flat;
        s->constant = kind.constant;
        if (value < 0 && block >= 0 && t.base != GLSL_SAMPLER) // drivers set such variables to 0
            value = add(p, GLSL_CONSTANT, 0, t, begin);
        if (value < 0)
            continue;
        int target = add(p, GLSL_VARIABLE, 0, t, begin);
        p->nodes[target].at = s->at;
        int node = with(p, GLSL_ASSIGN, '=', t, begin, target, value);
        if (p->unsupported[0])
            return;
        if (block >= 0)
            append(p, block, node);
        else if (p->initializer_count < 64)
            p->initializers[p->initializer_count++] = node;
        else
            stop(p, "too many initializers");
        p->steps = 10000;
        if (kind.constant || block < 0)
            glsl_value(p, node);
    } while (!p->unsupported[0] && take(p, ","));
}

// Parses { members } of a struct or a block, and returns its type.
static struct glsl_type structure(struct glsl_program *p, const char *name)
{
    struct glsl_type out = {GLSL_STRUCT, 1, 1, (uint8_t)p->structure_count, 0};
    if (p->structure_count == GLSL_STRUCTURES) {
        stop(p, "too many structs");
        return type_float;
    }
    struct glsl_structure s = {.first = p->member_count};
    snprintf(s.name, sizeof s.name, "%.63s", name);
    expect(p, "{");
    while (!p->unsupported[0] && !take(p, "}")) {
        while (is(p, "flat") || is(p, "smooth"))
            p->at++;
        struct glsl_type base = skip_type(p);
        bool open = false;
        array_size(p, &base, &open);
        do {
            struct glsl_type t = base;
            const char *member = word(p);
            p->at++;
            array_size(p, &t, &open);
            if (open || p->member_count == GLSL_MEMBERS)
                stop(p, "members of a struct");
            if (p->unsupported[0])
                return type_float;
            struct glsl_member *m = &p->members[p->member_count++];
            *m = (struct glsl_member){.type = t, .offset = s.size};
            snprintf(m->name, sizeof m->name, "%.63s", member);
            s.size += glsl_size(p, t);
            if (s.size > MAX_MEMORY)
                stop(p, "too many members");
        } while (!p->unsupported[0] && take(p, ","));
        expect(p, ";");
    }
    s.count = p->member_count - s.first;
    p->structures[p->structure_count++] = s;
    return out;
}

static void block_members(struct glsl_program *p, struct glsl_type t, struct glsl_symbol kind)
{
    const struct glsl_structure *s = &p->structures[t.structure];
    for (int i = s->first; i < s->first + s->count; i++)
        declare(p, p->members[i].name, p->members[i].type, kind.storage)->flat = kind.flat;
}

static bool is_same(const struct glsl_function *a, const struct glsl_function *b)
{
    bool same = strcmp(a->name, b->name) == 0 && a->count == b->count;
    for (int i = 0; i < a->count && same; i++)
        same = accepts(a->types[i], b->types[i]) && a->types[i].base == b->types[i].base;
    return same;
}

static void function(struct glsl_program *p, const char *name, struct glsl_type type)
{
    const int outside = p->symbol_count;
    struct glsl_function f = {.type = type, .body = -1};
    snprintf(f.name, sizeof f.name, "%.63s", name);
    while (!p->unsupported[0] && !is(p, ")") && !(is(p, "void") && word_is(p->text, p->at + 1, ")"))) {
        uint8_t out = 1;
        for (; is(p, "in") || is(p, "out") || is(p, "inout") || is(p, "const"); p->at++)
            out = is(p, "out") ? 2 : is(p, "inout") ? 3 : out;
        struct glsl_type t = skip_type(p);
        bool open = false;
        array_size(p, &t, &open);
        char parameter[64] = "";
        if (word_is_name(word(p))) {
            snprintf(parameter, sizeof parameter, "%.63s", word(p));
            p->at++;
        }
        array_size(p, &t, &open);
        if (open || f.count == GLSL_PARAMETERS)
            stop(p, "parameters");
        if (p->unsupported[0])
            return;
        f.types[f.count] = t;
        f.out[f.count] = out;
        f.places[f.count++] = declare(p, parameter, t, GLSL_LOCAL)->at;
        if (!take(p, ","))
            break;
    }
    take(p, "void");
    expect(p, ")");
    f.result = reserve(p, glsl_size(p, type));
    int at = 0; // of the prototype, or of a new function
    while (at < p->function_count && !is_same(&p->functions[at], &f))
        at++;
    const bool prototype = take(p, ";");
    p->inner = strcmp(name, "main") != 0;
    f.body = prototype ? -1 : statement(p);
    p->inner = false;
    p->symbol_count = outside;
    if (strcmp(name, "main") == 0)
        p->main_body = f.body;
    else if (at == GLSL_FUNCTIONS)
        stop(p, "too many functions");
    else if (!prototype || at == p->function_count)
        p->functions[at] = f;
    p->function_count += strcmp(name, "main") != 0 && at == p->function_count && at < GLSL_FUNCTIONS;
}

static bool qualifier(struct glsl_program *p, struct glsl_symbol *kind)
{
    static const char *const ignored[] = {"highp",    "mediump",   "lowp",    "smooth",  "noperspective",
                                          "centroid", "invariant", "precise", "readonly"};
    if (take(p, "layout")) {
        while (!p->unsupported[0] && !take(p, ")"))
            p->at += p->at < p->text->word_count ? 1 : stop(p, "layout");
        return true;
    }
    for (size_t i = 0; i < sizeof ignored / sizeof *ignored; i++)
        if (take(p, ignored[i]))
            return true;
    if (take(p, "const"))
        return kind->constant = true;
    if (take(p, "flat"))
        return kind->flat = true;
    if (is(p, "uniform") || is(p, "in") || is(p, "out") || is(p, "attribute") || is(p, "varying")) {
        kind->storage = is(p, "uniform")                                  ? GLSL_UNIFORM
                        : is(p, "out") || (is(p, "varying") && p->vertex) ? GLSL_OUTPUT
                                                                          : GLSL_INPUT;
        p->at++;
        return true;
    }
    return false;
}

static void global(struct glsl_program *p)
{
    struct glsl_symbol kind = {.storage = GLSL_LOCAL};
    struct glsl_type t;
    bool open = false;
    while (qualifier(p, &kind))
        continue;
    if (take(p, ";"))
        return;
    if (take(p, "precision")) {
        p->at += 2;
    } else if (is(p, "struct") || word_is(p->text, p->at + 1, "{")) {
        bool block = !take(p, "struct");
        char name[64];
        snprintf(name, sizeof name, "%.63s", is(p, "{") ? "" : word(p));
        p->at += !is(p, "{");
        t = structure(p, name);
        if (block && !p->unsupported[0] && is(p, ";"))
            block_members(p, t, kind);
        else if (block && kind.storage != GLSL_UNIFORM && !p->unsupported[0]) {
            // Blocks of two stages match by the block's name, so the instance becomes a second name of the block.
            struct glsl_symbol *s = declare(p, name, t, kind.storage);
            *declare(p, word(p), type_void, GLSL_LOCAL) = *s;
            snprintf(p->symbols[p->symbol_count - 1].name, sizeof s->name, "%.63s", word(p));
            p->symbols[p->symbol_count - 1].storage = GLSL_LOCAL;
            p->at++;
        } else if (!is(p, ";"))
            names(p, t, kind, -1);
    } else {
        const char *name;
        t = skip_type(p);
        array_size(p, &t, &open);
        name = word(p);
        if (word_is(p->text, p->at + 1, "(")) {
            p->at += 2;
            function(p, name, t);
            return;
        }
        if (!is(p, ";") && !p->unsupported[0] && !find(p, name)) // a redeclared built-in variable is ignored
            names(p, t, kind, -1);
        else
            p->at += !is(p, ";");
    }
    expect(p, ";");
}

// --- statements

static int local(struct glsl_program *p)
{
    struct glsl_symbol kind = {.storage = GLSL_LOCAL};
    struct glsl_type t = type_float;
    bool open = false;
    const int begin = p->at;
    while (is(p, "const") || is(p, "highp") || is(p, "mediump") || is(p, "lowp")) {
        kind.constant = kind.constant || is(p, "const");
        p->at++;
    }
    if (!type_named(p, word(p), &t) || word_is(p->text, p->at + 1, "(") || word_is(p->text, p->at + 1, "."))
        return -1;
    p->at++;
    array_size(p, &t, &open);
    kind.constant = false; // its value may depend on inputs
    int block = add(p, GLSL_BLOCK, 0, type_void, begin);
    if (!p->unsupported[0])
        names(p, t, kind, block);
    expect(p, ";");
    return block;
}

static int simple(struct glsl_program *p)
{
    if (take(p, ";"))
        return add(p, GLSL_EMPTY, 0, type_void, p->at);
    int node = local(p);
    if (node >= 0)
        return node;
    node = expression(p);
    expect(p, ";");
    return node;
}

static int loop(struct glsl_program *p, bool counted)
{
    const int begin = p->at, outside = p->symbol_count;
    int start, condition, step;
    expect(p, "(");
    start = counted ? simple(p) : add(p, GLSL_EMPTY, 0, type_void, begin);
    if (counted && take(p, ";"))
        condition = add(p, GLSL_EMPTY, 0, type_void, begin);
    else {
        condition = expression(p);
        if (counted)
            expect(p, ";");
    }
    step = counted && !is(p, ")") ? expression(p) : add(p, GLSL_EMPTY, 0, type_void, begin);
    expect(p, ")");
    int body = statement(p);
    p->symbol_count = outside;
    if (p->unsupported[0])
        return 0;
    int node = with(p, GLSL_LOOP, 0, type_void, begin, start, condition);
    append(p, node, step);
    append(p, node, body);
    return node;
}

static int statement(struct glsl_program *p)
{
    const int begin = p->at, outside = p->symbol_count;
    int node = 0;
    if (p->depth++ > MAX_DEPTH)
        return stop(p, "too deeply nested");
    if (take(p, "{")) {
        node = add(p, GLSL_BLOCK, 0, type_void, begin);
        while (!p->unsupported[0] && !take(p, "}"))
            append(p, node, statement(p));
        p->symbol_count = outside;
    } else if (take(p, "if")) {
        expect(p, "(");
        int condition = expression(p);
        expect(p, ")");
        int yes = statement(p), no = take(p, "else") ? statement(p) : -1;
        if (!p->unsupported[0]) {
            node = with(p, GLSL_IF, 0, type_void, begin, condition, yes);
            if (no >= 0)
                append(p, node, no);
        }
    } else if (take(p, "for"))
        node = loop(p, true);
    else if (take(p, "while"))
        node = loop(p, false);
    else if (take(p, "return")) {
        node = add(p, GLSL_RETURN, 0, type_void, begin);
        if (!is(p, ";"))
            append(p, node, expression(p));
        expect(p, ";");
    } else if (is(p, "break") || is(p, "continue") || is(p, "discard")) {
        node = add(p,
                   is(p, "break")      ? GLSL_BREAK
                   : is(p, "continue") ? GLSL_CONTINUE
                                       : GLSL_DISCARD,
                   0, type_void, begin);
        p->at++;
        expect(p, ";");
    } else if (is(p, "do") || is(p, "switch") || is(p, "struct"))
        stop(p, word(p));
    else
        node = simple(p);
    p->depth--;
    return node;
}

static void declare_built_ins(struct glsl_program *p)
{
    static const struct {
        const char *name, *type;
        int storage, count;
    } rows[] = {{"gl_Vertex", "vec4", GLSL_INPUT, 0},
                {"gl_Normal", "vec3", GLSL_INPUT, 0},
                {"gl_Color", "vec4", GLSL_INPUT, 0},
                {"gl_MultiTexCoord0", "vec4", GLSL_INPUT, 0},
                {"gl_ModelViewMatrix", "mat4", GLSL_UNIFORM, 0},
                {"gl_ProjectionMatrix", "mat4", GLSL_UNIFORM, 0},
                {"gl_ModelViewProjectionMatrix", "mat4", GLSL_UNIFORM, 0},
                {"gl_NormalMatrix", "mat3", GLSL_UNIFORM, 0},
                {"gl_ModelViewMatrixInverse", "mat4", GLSL_UNIFORM, 0},
                {"gl_ModelViewMatrixInverseTranspose", "mat4", GLSL_UNIFORM, 0},
                {"gl_Position", "vec4", GLSL_LOCAL, 0},
                {"gl_FrontColor", "vec4", GLSL_OUTPUT, 0},
                {"gl_BackColor", "vec4", GLSL_OUTPUT, 0},
                {"gl_TexCoord", "vec4", GLSL_OUTPUT, 8},
                {"gl_ClipDistance", "float", GLSL_LOCAL, 8},
                {"gl_PointSize", "float", GLSL_LOCAL, 0},
                {"gl_FragDepth", "float", GLSL_LOCAL, 0},
                {"gl_FragCoord", "vec4", GLSL_LOCAL, 0},
                {"gl_FrontFacing", "bool", GLSL_LOCAL, 0},
                {"gl_FragColor", "vec4", GLSL_LOCAL, 0},
                {"gl_FragData", "vec4", GLSL_LOCAL, 4}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct glsl_type t;
        type_named(p, rows[i].type, &t);
        t.count = (uint16_t)rows[i].count;
        int storage = rows[i].storage == GLSL_OUTPUT && !p->vertex ? GLSL_INPUT : rows[i].storage;
        struct glsl_symbol *s = declare(p, rows[i].name, t, storage);
        if (strcmp(rows[i].name, "gl_FrontFacing") == 0)
            p->memory[s->at] = 1;
    }
}

bool glsl_parse(struct glsl_program *p, const struct declarations *text, bool vertex, struct arena *arena)
{
    *p = (struct glsl_program){.text = text, .vertex = vertex, .main_body = -1};
    if (text->word_count > MAX_PARSED)
        return stop(p, "too long");
    p->node_capacity = 2 * text->word_count + 512;
    p->nodes = arena_array(arena, (size_t)p->node_capacity, sizeof *p->nodes);
    p->memory = arena_array(arena, 2 * MAX_MEMORY, sizeof *p->memory); // operands of wrong types may be read too far
    if (!p->nodes || !p->memory)
        return stop(p, "out of memory");
    for (int i = 0; i < 2 * MAX_MEMORY; i++)
        p->memory[i] = 0;
    declare_built_ins(p);
    while (!p->unsupported[0] && p->at < text->word_count)
        global(p);
    for (int i = 0; i < p->function_count && !p->unsupported[0]; i++)
        if (p->functions[i].body < 0)
            stop(p, p->functions[i].name); // declared, but not defined
    return !p->unsupported[0] && (p->main_body >= 0 || stop(p, "there is no main()"));
}
