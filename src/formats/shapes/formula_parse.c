// formula_parse.c: parses the text of a formula, "a = 2; x = …; y = …; z = …" or "a = 2; x^2 + … - a", by recursive
// descent.
//
//  text      = [ statement ] { (";" | newline) [ statement ] }
//  statement = name "=" sum | sum [ "=" sum ]               the latter once, last, and only for an implicit surface
//  sum       = product { ("+" | "-") product }
//  product   = sign { ("*" | "/") sign }
//  sign      = { "-" | "+" } factor
//  factor    = number factor-without-a-number | power       2pi is 2·pi, with the precedence of a product
//  power     = primary [ "^" { "-" | "+" } power ]          from the right: 2^3^2 is 2^9, -2^2 is -4
//  primary   = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
//
// After "/" or "^", a number must not be followed by a factor without "*": 1/2pi would be ambiguous.
#include "formula.h"

#include "fail.h"
#include "linear.h"
#include "number.h"
#include "shown_name.h"
#include "spelling.h"

#include <stdio.h>
#include <string.h>

struct parser {
    struct formula *formula;
    const char *what; // the noun for the text in error messages: "formula"
    const char *text, *at, *end;
    int depth;
    lam_error *error;
};

static const struct function {
    const char *name;
    enum formula_op op; // NUMBER for a function that is composed of other operations
    int least, most;    // number of arguments
} functions[] = {
    {"sin", OP_SIN, 1, 1},   {"cos", OP_COS, 1, 1},     {"tan", OP_TAN, 1, 1},     {"asin", OP_ASIN, 1, 1},
    {"acos", OP_ACOS, 1, 1}, {"atan", OP_ATAN, 1, 1},   {"atan2", OP_ATAN2, 2, 2}, {"sinh", OP_SINH, 1, 1},
    {"cosh", OP_COSH, 1, 1}, {"tanh", OP_TANH, 1, 1},   {"exp", OP_EXP, 1, 1},     {"log", OP_LOG, 1, 1},
    {"ln", OP_LOG, 1, 1},    {"sqrt", OP_SQRT, 1, 1},   {"cbrt", OP_CBRT, 1, 1},   {"abs", OP_ABS, 1, 1},
    {"sign", OP_SIGN, 1, 1}, {"floor", OP_FLOOR, 1, 1}, {"mod", OP_MOD, 2, 2},     {"min", OP_MIN, 2, 8},
    {"max", OP_MAX, 2, 8},   {"hypot", OP_HYPOT, 2, 2}, {"pow", OP_POW, 2, 2},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static const struct constant {
    const char *name;
    double value;
} constants[] = {{"pi", PI}, {"\xcf\x80", PI}, {"tau", 2 * PI}, {"e", 2.71828182845904523536}};
enum { CONSTANTS = sizeof constants / sizeof *constants };

static bool is(const char *name, const char *at, size_t length)
{
    return strlen(name) == length && memcmp(name, at, length) == 0;
}

// Returns the names of the parameters for messages.
static const char *parameter_names(const struct formula *formula) { return formula->implicit ? "x, y, z" : "u, v"; }

// Returns the index of the parameter with this name, or −1 if there is none.
static int find_parameter(const struct formula *formula, const char *at, size_t length)
{
    for (int i = 0; i < (formula->implicit ? 3 : 2); i++)
        if (is((const char[]){formula->implicit ? "xyz"[i] : "uv"[i], 0}, at, length))
            return i;
    return -1;
}

// --- errors

static int column_of(const struct parser *p, const char *at)
{
    int column = 1;
    for (const char *c = p->text; c < at; c++)
        column += ((unsigned char)*c & 0xc0) != 0x80; // characters, not bytes
    return column;
}

static size_t name_length(const char *at, const char *end)
{
    size_t length = 0;
    if (end - at >= 2 && memcmp(at, "\xcf\x80", 2) == 0)
        return 2;
    while (at + length < end && ((at[length] >= 'a' && at[length] <= 'z') || (at[length] >= 'A' && at[length] <= 'Z') ||
                                 at[length] == '_' || (length && at[length] >= '0' && at[length] <= '9')))
        length++;
    return length;
}

// Returns the text at a position for messages: "'sin'", "the end".
static const char *found_at(const struct parser *p, const char *at, char out[SHOWN_NAME_SIZE + 2])
{
    if (at >= p->end)
        return "the end";
    if (*at == '\n')
        return "the end of the line";
    double number;
    const uint8_t *past =
        *at >= '0' && *at <= '9' ? number_double((const uint8_t *)at, (const uint8_t *)p->end, &number) : NULL;
    size_t length = past ? (size_t)(past - (const uint8_t *)at) : name_length(at, p->end);
    if (!length) {
        int utf8 = lam_utf8_length(at, (size_t)(p->end - at));
        length = utf8 > 0 ? (size_t)utf8 : 1;
    }
    char shown[SHOWN_NAME_SIZE];
    snprintf(out, SHOWN_NAME_SIZE + 2, "'%s'", shown_name_of(at, length, shown));
    return out;
}

static int expected(struct parser *p, const char *at, const char *what)
{
    char found[SHOWN_NAME_SIZE + 2];
    fail(p->error, LAM_BAD_ARGUMENT, "%s, column %d: found %s, expected %s", p->what, column_of(p, at),
         found_at(p, at, found), what);
    return -1;
}

// --- tokens

static void skip_blanks(struct parser *p)
{
    while (p->at < p->end && (*p->at == ' ' || *p->at == '\t' || *p->at == '\r' || (*p->at == '\n' && p->depth > 1)))
        p->at++;
}

// Accepts a character, or the typographic character that pasted formulas contain instead.
static bool take(struct parser *p, char character)
{
    static const struct {
        char plain;
        const char *same;
    } others[] = {{'-', "\xe2\x88\x92"}, {'*', "\xc2\xb7"}, {'*', "\xc3\x97"}};
    skip_blanks(p);
    if (p->at < p->end && *p->at == character) {
        p->at++;
        return true;
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        size_t length = strlen(others[i].same);
        if (others[i].plain == character && (size_t)(p->end - p->at) >= length &&
            memcmp(p->at, others[i].same, length) == 0) {
            p->at += length;
            return true;
        }
    }
    return false;
}

// Accepts "**", which some languages use for "^"; it is not a product.
static bool take_power(struct parser *p)
{
    if (take(p, '^'))
        return true;
    if (p->end - p->at < 2 || p->at[0] != '*' || p->at[1] != '*')
        return false;
    p->at += 2;
    return true;
}

static bool take_times(struct parser *p)
{
    skip_blanks(p);
    return !(p->end - p->at >= 2 && p->at[0] == '*' && p->at[1] == '*') && take(p, '*');
}

static const struct function *find_function(const char *at, size_t length)
{
    for (int i = 0; i < FUNCTIONS; i++)
        if (is(functions[i].name, at, length))
            return &functions[i];
    return NULL;
}

static const struct constant *find_constant(const char *at, size_t length)
{
    for (int i = 0; i < CONSTANTS; i++)
        if (is(constants[i].name, at, length))
            return &constants[i];
    return NULL;
}

static const struct formula_name *find_name(const struct formula *formula, const char *at, size_t length)
{
    for (int i = 0; i < formula->name_count; i++)
        if (formula->names[i].length == length && memcmp(formula->names[i].text, at, length) == 0)
            return &formula->names[i];
    return NULL;
}

// --- expressions; each function returns a node, or −1 after an error

static int sum(struct parser *p);

static bool deeper(struct parser *p)
{
    return ++p->depth <= FORMULA_DEPTH_MAX ||
           fail(p->error, LAM_LIMIT, "%s, column %d: more than %d levels of parentheses, signs and powers", p->what,
                column_of(p, p->at), FORMULA_DEPTH_MAX);
}

static int call(struct parser *p, const struct function *function)
{
    struct formula_graph *graph = &p->formula->graph;
    const char *start = p->at - strlen(function->name);
    int result = -1, count = 0;
    char text[80];
    snprintf(text, sizeof text, "'(' and an argument of %s: %s(%c)", function->name, function->name,
             *parameter_names(p->formula));
    if (!take(p, '('))
        return expected(p, p->at, text);
    if (!deeper(p))
        return -1;
    do {
        int next = sum(p);
        if (next < 0)
            return -1;
        result = count++ == 0             ? next
                 : count > function->most ? result
                                          : formula_binary(graph, function->op, result, next);
    } while (take(p, ','));
    if (!take(p, ')'))
        return expected(p, p->at, "an operator, ',' or ')'");
    p->depth--;
    if (count < function->least || count > function->most) {
        fail(p->error, LAM_BAD_ARGUMENT, "%s, column %d: %s has %d argument%s, expected %s%d", p->what,
             column_of(p, start), function->name, count, count == 1 ? "" : "s",
             function->most > function->least ? count < function->least ? "at least " : "at most " : "",
             count < function->least ? function->least : function->most);
        return -1;
    }
    return function->most > 1 ? result : formula_unary(graph, function->op, result);
}

static int unknown_name(struct parser *p, const char *start, size_t length)
{
    const char *known[FUNCTIONS + CONSTANTS];
    char name[SHOWN_NAME_SIZE], text[200];
    for (int i = 0; i < FUNCTIONS; i++)
        known[i] = functions[i].name;
    for (int i = 0; i < CONSTANTS; i++)
        known[FUNCTIONS + i] = constants[i].name;
    const char *near = meant_word(shown_name_of(start, length, name), known, FUNCTIONS + CONSTANTS);
    snprintf(text, sizeof text, "%s, a number, a function, or a name that is defined before%s%s%s",
             parameter_names(p->formula), near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    return expected(p, start, text);
}

static int primary(struct parser *p, bool *is_number)
{
    struct formula_graph *graph = &p->formula->graph;
    const char *start;
    double value;
    *is_number = false;
    if (take(p, '(')) {
        if (!deeper(p))
            return -1;
        int inner = sum(p);
        if (inner >= 0 && !take(p, ')'))
            return expected(p, p->at, "an operator or ')'");
        p->depth--;
        return inner;
    }
    start = p->at;
    bool digit = start < p->end && *start >= '0' && *start <= '9';
    if (digit || (p->end - start >= 2 && *start == '.' && start[1] >= '0' && start[1] <= '9')) {
        p->at = (const char *)number_double((const uint8_t *)start, (const uint8_t *)p->end, &value);
        if (!math_finite(value))
            return expected(p, start, "a number below 1.8e308");
        *is_number = true;
        return formula_number(graph, value);
    }
    size_t length = name_length(start, p->end);
    if (!length)
        return expected(p, start,
                        p->formula->implicit ? "a number, x, y, z, a name, a function or '('"
                                             : "a number, u, v, a name, a function or '('");
    p->at += length;
    int parameter = find_parameter(p->formula, start, length);
    if (parameter >= 0)
        return formula_unary(graph, (enum formula_op)(OP_PARAMETER_0 + parameter), 0);
    const struct function *function = find_function(start, length);
    if (function)
        return call(p, function);
    const struct constant *constant = find_constant(start, length);
    if (constant)
        return formula_number(graph, constant->value);
    const struct formula_name *name = find_name(p->formula, start, length);
    return name ? name->node : unknown_name(p, start, length);
}

static int power(struct parser *p, bool *is_number)
{
    if (!deeper(p))
        return -1;
    int base = primary(p, is_number);
    if (base >= 0 && take_power(p)) {
        bool negative = false, ignored;
        *is_number = false;
        for (;;) {
            if (take(p, '-'))
                negative = !negative;
            else if (!take(p, '+'))
                break;
        }
        int exponent = power(p, &ignored);
        if (exponent < 0)
            return -1;
        if (negative)
            exponent = formula_unary(&p->formula->graph, OP_NEG, exponent);
        base = formula_binary(&p->formula->graph, OP_POW, base, exponent);
    }
    p->depth--;
    return base;
}

// Returns whether the text continues with a factor that needs no '*' after a number: a name or a parenthesis.
static bool factor_follows(struct parser *p)
{
    skip_blanks(p);
    return p->at < p->end && (*p->at == '(' || name_length(p->at, p->end));
}

static int signed_factor(struct parser *p, bool divides)
{
    bool negative = false, is_number;
    for (;;) {
        if (take(p, '-'))
            negative = !negative;
        else if (!take(p, '+'))
            break;
    }
    skip_blanks(p);
    const char *start = p->at;
    int result = power(p, &is_number);
    if (result >= 0 && is_number && factor_follows(p)) {
        if (divides)
            return expected(p, start, "parentheses around a divisor that is a product, as in 1/(2*pi), or a '*'");
        int next = power(p, &is_number);
        if (next < 0)
            return -1;
        result = formula_binary(&p->formula->graph, OP_MUL, result, next);
    }
    return result >= 0 && negative ? formula_unary(&p->formula->graph, OP_NEG, result) : result;
}

static int product(struct parser *p)
{
    int result = signed_factor(p, false);
    while (result >= 0) {
        bool times = take_times(p), over = !times && take(p, '/');
        if (!times && !over)
            break;
        int next = signed_factor(p, over);
        result = next < 0 ? -1 : formula_binary(&p->formula->graph, times ? OP_MUL : OP_DIV, result, next);
    }
    return result;
}

static int sum(struct parser *p)
{
    if (!deeper(p))
        return -1;
    int result = product(p);
    while (result >= 0) {
        bool plus = take(p, '+'), minus = !plus && take(p, '-');
        if (!plus && !minus)
            break;
        int next = product(p);
        result = next < 0 ? -1 : formula_binary(&p->formula->graph, plus ? OP_ADD : OP_SUB, result, next);
    }
    p->depth--;
    return result;
}

// --- the whole text

static bool too_large(const char *what, lam_error *error)
{
    return fail(error, LAM_LIMIT, "%s: it and its derivatives take more than %d operations", what, FORMULA_NODES_MAX);
}

static bool definition(struct parser *p)
{
    const char *start = p->at;
    size_t length = name_length(start, p->end);
    if (!length)
        return expected(p, start, "a definition, such as x = cos(u)") >= 0;
    if (find_parameter(p->formula, start, length) >= 0 || find_function(start, length) || find_constant(start, length))
        return expected(p, start,
                        p->formula->implicit ? "another name: this one is predefined"
                                             : "x, y, z or another name: this one is predefined") >= 0;
    if (find_name(p->formula, start, length))
        return expected(p, start, "a new name: this one is already defined") >= 0;
    p->at += length;
    if (!take(p, '='))
        return expected(p, p->at, "'='") >= 0;
    int node = sum(p);
    if (node < 0)
        return false;
    skip_blanks(p);
    if (p->at < p->end && *p->at != ';' && *p->at != '\n')
        return expected(p, p->at, "an operator or ';'") >= 0;
    p->formula->names[p->formula->name_count++] = (struct formula_name){start, length, node};
    return !p->formula->graph.full || too_large(p->what, p->error);
}

// Returns whether a definition follows instead of an expression. x = … is an equation, because x cannot be defined.
static bool is_definition(const struct parser *p)
{
    struct parser ahead = *p;
    size_t length = name_length(p->at, p->end);
    ahead.at += length;
    return length && find_parameter(p->formula, p->at, length) < 0 && take(&ahead, '=');
}

// Parses the expression that is zero on an implicit surface, "x^2 + y^2 - 1", or an equation, "x^2 + y^2 = 1".
static bool zero_of(struct parser *p)
{
    int node = sum(p);
    if (node >= 0 && take(p, '=')) {
        int right = sum(p);
        node = right < 0 ? -1 : formula_binary(&p->formula->graph, OP_SUB, node, right);
    }
    while (node >= 0 && (skip_blanks(p), p->at < p->end) && (*p->at == ';' || *p->at == '\n'))
        p->at++;
    if (node >= 0 && p->at < p->end)
        return expected(p, p->at, "an operator, '=' or the end") >= 0;
    p->formula->outputs[0] = node;
    return node >= 0 && (!p->formula->graph.full || too_large(p->what, p->error));
}

bool formula_parse(const char *text, bool implicit, struct arena *arena, struct formula *formula, lam_error *error)
{
    size_t length = strlen(text);
    if (length > FORMULA_BYTES_MAX)
        return fail(error, LAM_LIMIT, "formula: the text has %zu bytes, expected at most %d", length,
                    FORMULA_BYTES_MAX);
    *formula = (struct formula){.names = arena_array(arena, FORMULA_BYTES_MAX / 2 + 1, sizeof *formula->names),
                                .implicit = implicit};
    if (!formula->names || !formula_graph_start(&formula->graph, arena))
        return call_memory_error(arena->call, FORMULA_NODES_MAX * sizeof(struct formula_node), error);
    struct parser p = {
        .formula = formula, .what = "formula", .text = text, .at = text, .end = text + length, .error = error};
    formula_number(&formula->graph, 0);
    while (skip_blanks(&p), p.at < p.end) {
        if (*p.at == ';' || *p.at == '\n')
            p.at++;
        else if (implicit && !is_definition(&p))
            return zero_of(&p);
        else if (!definition(&p))
            return false;
    }
    if (implicit)
        return expected(&p, p.at, "an expression that is zero on the surface, such as x^2+y^2+z^2-1") >= 0;
    for (int i = 0; i < 3; i++) {
        const char name[2] = {"xyz"[i], 0};
        const struct formula_name *found = find_name(formula, name, 1);
        if (!found)
            return fail(error, LAM_BAD_ARGUMENT, "formula: %s is missing, expected x=...; y=...; z=...", name);
        formula->outputs[i] = found->node;
    }
    return true;
}

bool formula_range(struct formula *formula, const char *name, const char *text, double range[2], lam_error *error)
{
    char what[40];
    snprintf(what, sizeof what, "range of %s", name);
    const char *dots = strstr(text, "..");
    if (strlen(text) > FORMULA_BYTES_MAX)
        return fail(error, LAM_LIMIT, "%s: the text is longer than %d bytes", what, FORMULA_BYTES_MAX);
    if (!dots)
        return fail(error, LAM_BAD_ARGUMENT, "%s: found '%.100s', expected two numbers and '..' between them, 0..2pi",
                    what, text);
    for (int i = 0; i < 2; i++) {
        struct parser p = {.formula = formula,
                           .what = what,
                           .text = text,
                           .at = i ? dots + 2 : text,
                           .end = i ? text + strlen(text) : dots,
                           .error = error};
        const char *start = p.at;
        int node = sum(&p);
        if (node < 0)
            return false;
        skip_blanks(&p);
        if (p.at < p.end)
            return expected(&p, p.at, "an operator or the end") >= 0;
        if (formula->graph.full)
            return too_large(what, error);
        const struct formula_node *n = &formula->graph.nodes[node];
        if (n->op != OP_NUMBER || !math_finite(n->value))
            return fail(error, LAM_BAD_ARGUMENT, "%s, column %d: expected a constant, a finite number without %s", what,
                        column_of(&p, start), parameter_names(formula));
        range[i] = n->value;
    }
    return range[0] < range[1] ||
           fail(error, LAM_BAD_ARGUMENT, "%s: %.10g..%.10g is empty, expected the smaller end first", what, range[0],
                range[1]);
}

bool formula_finish(struct formula *formula, struct arena *arena, lam_error *error)
{
    struct formula_graph *graph = &formula->graph;
    int count = graph->count, values = formula->implicit ? 1 : 3, parameters = formula->implicit ? 3 : 2;
    int outputs = values * (1 + parameters);
    int *derivatives = arena_array(arena, (size_t)parameters * (size_t)count, sizeof *derivatives);
    bool *used = arena_alloc_zeroed(arena, FORMULA_NODES_MAX * sizeof *used);
    int *moved = arena_array(arena, FORMULA_NODES_MAX, sizeof *moved);
    formula->nodes = arena_array(arena, FORMULA_NODES_MAX, sizeof *formula->nodes);
    if (!derivatives || !used || !moved || !formula->nodes)
        return call_memory_error(arena->call, FORMULA_NODES_MAX * sizeof(struct formula_node), error);
    for (int k = 0; k < parameters && !graph->full; k++)
        formula_differentiate(graph, count, (enum formula_op)(OP_PARAMETER_0 + k), derivatives + k * count);
    if (graph->full)
        return too_large("formula", error);
    for (int i = values; i < outputs; i++)
        formula->outputs[i] = derivatives[(i / values - 1) * count + formula->outputs[i % values]];
    for (int i = 0; i < outputs; i++)
        used[formula->outputs[i]] = true;
    for (int i = graph->count - 1; i >= 0; i--)
        if (used[i] && graph->nodes[i].op >= OP_ADD)
            used[graph->nodes[i].a] = used[graph->nodes[i].b] = true;
    for (int i = 0; i < graph->count; i++) {
        if (!used[i])
            continue;
        struct formula_node n = graph->nodes[i];
        if (n.op >= OP_ADD)
            n.a = moved[n.a];
        n.b = n.op >= OP_ADD && n.op < OP_FIRST_UNARY ? moved[n.b] : n.a;
        moved[i] = formula->count;
        formula->nodes[formula->count++] = n;
    }
    for (int i = 0; i < outputs; i++)
        formula->outputs[i] = moved[formula->outputs[i]];
    return true;
}
