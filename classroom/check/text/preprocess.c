// preprocess.c: splits a GLSL source into words, and executes the preprocessor's directives.
#include "declarations.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A step is one token, macro or word that a loop looks at. The number of steps is limited, because a short text can
// contain macros that expand to any number of words.
enum { MAX_STEPS = 1 << 21, MAX_PARAMETERS = 16, MAX_NESTING = 32, MAX_EXPANSION_DEPTH = 64 };
enum { HASH_SIZE = 1 << 14 };

struct token {
    char text[64]; // a token, or "\n", which ends a directive; "#" starts a directive
    int line;
    bool directive; // whether the token is the '#' of a directive
    bool glued;     // no space before the token: #define F(x) has a parameter, #define F (x) has none
};

struct tokens {
    struct token *items;
    int count;
};

struct macro {
    char name[64];
    int next;                         // the next macro with the same hash: 1 + its index, or 0
    bool defined, function, disabled; // `disabled` is set during the macro's own expansion
    int parameter_count;
    char parameters[MAX_PARAMETERS][64];
    const struct token *body;
    int body_count;
};

struct preprocessor {
    struct declarations *d;
    struct tokens tokens;
    struct macro *macros;
    int macro_count;
    int heads[HASH_SIZE]; // for each hash, 1 + the index of the newest macro, or 0
    int depth;            // nesting of braces
    int steps;            // limited to MAX_STEPS
    bool failed;          // out of memory
    int nesting;          // nesting of #if
    struct {
        bool active, taken, outer;
    } branches[MAX_NESTING];
};

static bool is_name(char c) { return isalnum((unsigned char)c) || c == '_'; }

static bool is(const struct token *t, const char *text) { return strcmp(t->text, text) == 0; }

// Makes space for one more element. The capacity doubles when `count` is a power of two. Returns NULL if memory runs
// out.
static void *grown(void *items, int count, size_t size)
{
    if (count & (count - 1))
        return items;
    return realloc(items, (count ? 2 * (size_t)count : 1) * size);
}

// Counts a step. Returns false if the preprocessor must end.
static bool step(struct preprocessor *p)
{
    p->d->cut = p->d->cut || ++p->steps > MAX_STEPS;
    return !p->d->cut && !p->failed;
}

// --- tokens

static bool add_token(struct tokens *t, const char *from, size_t length, int line, bool glued)
{
    struct token *items = grown(t->items, t->count, sizeof *items);
    if (!items)
        return false;
    t->items = items;
    struct token *new = &items[t->count++];
    *new = (struct token){.line = line, .glued = glued};
    snprintf(new->text, sizeof new->text, "%.*s", (int)(length < 63 ? length : 63), from);
    return true;
}

// Returns the length of a backslash and the line ending after it, or 0 if `c` does not start with a backslash and a
// line ending.
static size_t continuation(const char *c)
{
    return c[0] != '\\' ? 0 : c[1] == '\n' ? 2 : c[1] == '\r' && c[2] == '\n' ? 3 : 0;
}

static const char *end_of_number(const char *c)
{
    while (is_name(*c) || *c == '.' || ((*c == '+' || *c == '-') && (c[-1] == 'e' || c[-1] == 'E')))
        c++;
    return c;
}

static bool split(struct tokens *t, const char *c)
{
    int line = 1;
    bool fresh = true, directive = false, ok = true, glued = false;
    if (strncmp(c, "\xef\xbb\xbf", 3) == 0) // a byte order mark
        c += 3;
    while (*c && ok) {
        const char *from = c;
        if (continuation(c)) {
            c += continuation(c);
            line++;
        } else if (*c == '\n') {
            if (directive)
                ok = add_token(t, "\n", 1, line, false);
            directive = false;
            fresh = true;
            line++;
            c++;
        } else if (isspace((unsigned char)*c)) {
            c++;
        } else if (c[0] == '/' && c[1] == '/') {
            while (*c && *c != '\n') {
                line += continuation(c) > 0;
                c += continuation(c) ? continuation(c) : 1;
            }
        } else if (c[0] == '/' && c[1] == '*') {
            for (c += 2; *c && !(c[0] == '*' && c[1] == '/'); c++)
                line += *c == '\n';
            c += *c ? 2 : 0;
        } else {
            c++;
            if (isdigit((unsigned char)*from) || (*from == '.' && isdigit((unsigned char)*c)))
                c = end_of_number(c);
            else if (is_name(*from))
                while (is_name(*c))
                    c++;
            ok = add_token(t, from, (size_t)(c - from), line, glued);
            if (ok && fresh && *from == '#')
                directive = t->items[t->count - 1].directive = true;
            fresh = false;
            glued = true;
            continue;
        }
        glued = false;
    }
    return ok && (!directive || add_token(t, "\n", 1, line, false));
}

// --- macros

// Adds a word to the result.
static void emit_word(struct preprocessor *p, const struct token *t, int line)
{
    struct declarations *d = p->d;
    d->cut = d->cut || d->word_count >= MAX_WORDS;
    if (!step(p))
        return;
    struct word *words = grown(d->words, d->word_count, sizeof *words);
    p->failed = !words;
    if (p->failed)
        return;
    d->words = words;
    struct word *w = &words[d->word_count];
    memcpy(w->text, t->text, sizeof w->text);
    w->number[0] = 0;
    w->line = line;
    p->depth -= is(t, "}");
    w->depth = p->depth;
    p->depth += is(t, "{");
    w->is_member = d->word_count > 0 && strcmp(w[-1].text, ".") == 0;
    d->word_count++;
}

// Adds a token to `out`, or to the result if `out` is NULL.
static void emit(struct preprocessor *p, struct tokens *out, const struct token *t, int line)
{
    if (!out)
        emit_word(p, t, line);
    else if (step(p) && !add_token(out, t->text, strlen(t->text), line, t->glued))
        p->failed = true;
}

// Returns the macro, which may be undefined again, or NULL if there was no such macro.
static struct macro *find_entry(struct preprocessor *p, const char *name)
{
    for (int i = p->heads[word_hash(name) % HASH_SIZE]; i && step(p); i = p->macros[i - 1].next)
        if (strcmp(p->macros[i - 1].name, name) == 0)
            return &p->macros[i - 1];
    return NULL;
}

static struct macro *find_macro(struct preprocessor *p, const char *name)
{
    struct macro *m = find_entry(p, name);
    return m && m->defined ? m : NULL;
}

struct argument {
    const struct token *from;
    int count;
};

// Parses the arguments after the name of a function-like macro. Returns the number of tokens up to the closing bracket,
// or 0 if no opening bracket follows the name.
static int read_arguments(struct preprocessor *p, const struct token *t, int count,
                          struct argument arguments[MAX_PARAMETERS], int *found)
{
    int depth = 0;
    *found = 0;
    if (count == 0 || !is(t, "("))
        return 0;
    arguments[0] = (struct argument){t + 1, 0};
    for (int i = 0; i < count && step(p); i++) {
        depth += is(&t[i], "(") - is(&t[i], ")");
        bool comma = depth == 1 && is(&t[i], ",");
        if (depth == 0 || comma) {
            if (*found < MAX_PARAMETERS) {
                arguments[*found].count = (int)(&t[i] - arguments[*found].from);
                (*found)++;
            }
            if (depth == 0)
                return i + 1;
            if (*found < MAX_PARAMETERS)
                arguments[*found] = (struct argument){&t[i + 1], 0};
        }
    }
    return 0;
}

static void expand(struct preprocessor *p, const struct token *t, int count, int line, int level, struct tokens *out);

// Adds the body of a macro to `out`, with its parameters replaced by the expanded arguments.
static void substitute(struct preprocessor *p, const struct macro *m, const struct argument *arguments,
                       int argument_count, int level, struct tokens *out)
{
    for (int i = 0; i < m->body_count && step(p); i++) {
        int k = 0;
        while (k < m->parameter_count && !is(&m->body[i], m->parameters[k]))
            k++;
        if (k < m->parameter_count && k < argument_count)
            expand(p, arguments[k].from, arguments[k].count, 0, level + 1, out);
        else
            emit(p, out, &m->body[i], m->body[i].line);
    }
}

// The name of a number, such as LIGHT_SPOT, is not expanded, because the name is more meaningful than the number. In
// the size of an array, such a name is expanded.
static bool is_named_number(const struct preprocessor *p, const struct macro *m)
{
    const struct declarations *d = p->d;
    return !m->function && m->body_count == 1 && isdigit((unsigned char)m->body[0].text[0]) &&
           !(d->word_count && strcmp(d->words[d->word_count - 1].text, "[") == 0);
}

// Adds tokens to `out` (see emit), with macros expanded. Every word has the line number `line`; if `line` is 0, words
// keep the lines of their tokens.
static void expand(struct preprocessor *p, const struct token *t, int count, int line, int level, struct tokens *out)
{
    for (int i = 0; i < count && step(p); i++) {
        int at = line ? line : t[i].line;
        struct macro *m = word_is_name(t[i].text) ? find_macro(p, t[i].text) : NULL;
        struct argument arguments[MAX_PARAMETERS];
        int argument_count = 0, taken = 0;
        if (m && m->function)
            taken = read_arguments(p, &t[i + 1], count - i - 1, arguments, &argument_count);
        if (!m || m->disabled || (m->function && !taken) || level > MAX_EXPANSION_DEPTH || is_named_number(p, m)) {
            const int before = p->d->word_count;
            emit(p, out, &t[i], at);
            if (m && p->d->word_count > before && m->body_count == 1 && !m->function)
                snprintf(p->d->words[before].number, sizeof p->d->words->number, "%.23s", m->body[0].text);
            continue;
        }
        struct tokens body = {0};
        substitute(p, m, arguments, argument_count, level, &body);
        m->disabled = true;
        expand(p, body.items, body.count, at, level + 1, out);
        m->disabled = false;
        free(body.items);
        i += taken;
    }
}

static void define(struct preprocessor *p, const struct token *t, int count)
{
    if (count < 1 || !word_is_name(t[0].text))
        return;
    struct macro *m = find_entry(p, t[0].text);
    int next = m ? m->next : 0;
    if (!m) {
        struct macro *macros = grown(p->macros, p->macro_count, sizeof *macros);
        p->failed = !macros;
        if (p->failed)
            return;
        p->macros = macros;
        m = &macros[p->macro_count++];
        int *head = &p->heads[word_hash(t[0].text) % HASH_SIZE];
        next = *head;
        *head = p->macro_count;
    }
    *m = (struct macro){.next = next, .defined = true, .function = count > 1 && is(&t[1], "(") && t[1].glued};
    memcpy(m->name, t[0].text, sizeof m->name);
    int at = 1;
    if (m->function) {
        for (at = 2; at < count && !is(&t[at], ")"); at++)
            if (word_is_name(t[at].text) && m->parameter_count < MAX_PARAMETERS)
                memcpy(m->parameters[m->parameter_count++], t[at].text, sizeof t[at].text);
        at++;
    }
    m->body = t + at;
    m->body_count = at < count ? count - at : 0;
}

static void undefine(struct preprocessor *p, const char *name)
{
    struct macro *m = find_macro(p, name);
    if (m)
        m->defined = false;
}

// --- conditions

struct condition {
    struct preprocessor *p;
    const struct token *t;
    int at, count, level;
};

static bool is_es(const struct declarations *d) { return strcmp(d->profile, "es") == 0 || d->version == 100; }

static bool is_defined(struct preprocessor *p, const char *name)
{
    bool core = p->d->version >= 150 && !is_es(p->d), compatibility = strcmp(p->d->profile, "compatibility") == 0;
    return find_macro(p, name) || (is_es(p->d) && strcmp(name, "GL_ES") == 0) ||
           (is_es(p->d) && strcmp(name, "GL_FRAGMENT_PRECISION_HIGH") == 0) ||
           (core && strcmp(name, "GL_core_profile") == 0) ||
           (compatibility && strcmp(name, "GL_compatibility_profile") == 0) || strcmp(name, "__VERSION__") == 0;
}

static bool next(struct condition *c, const char *text)
{
    int length = (int)strlen(text); // operators are split into tokens of one character
    for (int i = 0; i < length; i++)
        if (c->at + i >= c->count || c->t[c->at + i].text[0] != text[i] || c->t[c->at + i].text[1])
            return false;
    c->at += length;
    return true;
}

static long value_of(struct condition *c, int precedence);

static long value_of_name(struct condition *c, const char *name)
{
    const struct macro *m = find_macro(c->p, name);
    if (strcmp(name, "__VERSION__") == 0)
        return c->p->d->version ? c->p->d->version : 110;
    if (!m || m->function || c->level > MAX_EXPANSION_DEPTH)
        return is_defined(c->p, name) && !m;
    struct condition inner = {c->p, m->body, 0, m->body_count, c->level + 1};
    return value_of(&inner, 0);
}

static long primary(struct condition *c)
{
    if (!step(c->p) || c->level > MAX_EXPANSION_DEPTH)
        return 0;
    bool not = next(c, "!");
    if (not|| next(c, "-")) {
        c->level++;
        unsigned long value = (unsigned long)primary(c);
        c->level--;
        return not ? !value : (long)-value;
    }
    if (next(c, "(")) {
        long value = value_of(c, 0);
        next(c, ")");
        return value;
    }
    if (c->at >= c->count)
        return 0;
    const char *text = c->t[c->at++].text;
    if (strcmp(text, "defined") == 0) {
        bool bracket = next(c, "(");
        bool value = c->at < c->count && is_defined(c->p, c->t[c->at++].text);
        if (bracket)
            next(c, ")");
        return value;
    }
    return word_is_name(text) ? value_of_name(c, text) : strtol(text, NULL, 0);
}

// Binary operators in ascending precedence. "<=" is listed before "<", and ">=" before ">", so that the longer operator
// is found first.
static const struct {
    const char *text;
    int precedence;
} operators[] = {{"||", 1}, {"&&", 2}, {"==", 3}, {"!=", 3}, {"<=", 4}, {">=", 4}, {"<", 4},
                 {">", 4},  {"+", 5},  {"-", 5},  {"*", 6},  {"/", 6},  {"%", 6}};

static long apply(int operator, long a, long b)
{
    switch (operator) {
    case 0:
        return a || b;
    case 1:
        return a && b;
    case 2:
        return a == b;
    case 3:
        return a != b;
    case 4:
        return a <= b;
    case 5:
        return a >= b;
    case 6:
        return a < b;
    case 7:
        return a > b;
    case 8:
        return (long)((unsigned long)a + (unsigned long)b);
    case 9:
        return (long)((unsigned long)a - (unsigned long)b);
    case 10:
        return (long)((unsigned long)a * (unsigned long)b);
    case 11:
        return b > 0 ? a / b : 0;
    default:
        return b > 0 ? a % b : 0;
    }
}

static long value_of(struct condition *c, int precedence)
{
    long value = ++c->level < MAX_EXPANSION_DEPTH ? primary(c) : 0;
    for (int i = 0; i < (int)(sizeof operators / sizeof *operators); i++) {
        if (operators[i].precedence <= precedence || !next(c, operators[i].text))
            continue;
        value = apply(i, value, value_of(c, operators[i].precedence));
        i = -1; // restarts the loop
    }
    c->level--;
    return value;
}

static long value_of_line(struct preprocessor *p, const struct token *t, int count)
{
    struct condition c = {p, t, 0, count, 0};
    return value_of(&c, 0);
}

// --- directives

static bool is_active(const struct preprocessor *p)
{
    return p->nesting == 0 || p->nesting > MAX_NESTING || p->branches[p->nesting - 1].active;
}

static void open_branch(struct preprocessor *p, bool holds)
{
    bool outer = is_active(p);
    if (p->nesting++ < MAX_NESTING) {
        p->branches[p->nesting - 1].outer = outer;
        p->branches[p->nesting - 1].active = p->branches[p->nesting - 1].taken = outer && holds;
    }
}

static void other_branch(struct preprocessor *p, bool holds)
{
    if (p->nesting == 0 || p->nesting > MAX_NESTING)
        return;
    p->branches[p->nesting - 1].active =
        p->branches[p->nesting - 1].outer && !p->branches[p->nesting - 1].taken && holds;
    p->branches[p->nesting - 1].taken |= p->branches[p->nesting - 1].active;
}

// Executes a directive: the tokens after its '#'.
static void run_directive(struct preprocessor *p, const struct token *t, int count)
{
    if (count == 0)
        return;
    const struct token *name = count > 1 ? &t[1] : NULL;
    if (is(t, "if"))
        open_branch(p, value_of_line(p, t + 1, count - 1) != 0);
    else if (is(t, "ifdef") || is(t, "ifndef"))
        open_branch(p, name && is_defined(p, name->text) == is(t, "ifdef"));
    else if (is(t, "elif"))
        other_branch(p, value_of_line(p, t + 1, count - 1) != 0);
    else if (is(t, "else"))
        other_branch(p, true);
    else if (is(t, "endif"))
        p->nesting -= p->nesting > 0;
    else if (!is_active(p) || !name)
        return;
    else if (is(t, "define"))
        define(p, name, count - 1);
    else if (is(t, "undef"))
        undefine(p, name->text);
    else if (is(t, "version")) {
        p->d->version = atoi(name->text);
        if (count > 2 && word_is_name(t[2].text))
            snprintf(p->d->profile, sizeof p->d->profile, "%.15s", t[2].text);
    }
}

bool preprocess(struct declarations *d, const char *text)
{
    struct preprocessor *p = calloc(1, sizeof *p);
    if (!p)
        return false;
    const struct tokens *t = &p->tokens;
    p->d = d;
    p->failed = !split(&p->tokens, text);
    for (int i = 0; i < t->count && step(p);) {
        int end = i;
        if (t->items[i].directive) {
            while (!is(&t->items[end], "\n"))
                end++;
            run_directive(p, &t->items[i + 1], end - i - 1);
            i = end + 1;
        } else { // expands the source up to the next directive, because a macro's arguments may be on several lines
            while (end < t->count && !t->items[end].directive)
                end++;
            if (is_active(p))
                expand(p, &t->items[i], end - i, 0, 0, NULL);
            i = end;
        }
    }
    bool ok = !p->failed;
    free(p->tokens.items);
    free(p->macros);
    free(p);
    return ok;
}
