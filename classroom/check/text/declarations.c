// declarations.c: parses the declarations of a GLSL source.
#include "declarations.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "number.h"

// A struct type of the source.
struct struct_type {
    char name[64];
    int first, count; // range of the struct's members in reader.members
};

enum { MAX_STRUCT_TYPES = 16, MAX_MEMBERS = 128 };

struct declaration_parser {
    struct declarations *d;
    bool vertex; // the source is a vertex shader
    int at;      // index of the current word
    struct struct_type struct_types[MAX_STRUCT_TYPES];
    int struct_type_count;
    struct declaration members[MAX_MEMBERS];
    int member_count;
};

static const char *word_at(const struct declaration_parser *r, int ahead)
{
    return r->at + ahead < r->d->word_count ? r->d->words[r->at + ahead].text : "";
}

static bool next_is(const struct declaration_parser *r, const char *text) { return strcmp(word_at(r, 0), text) == 0; }

static bool take(struct declaration_parser *r, const char *text)
{
    bool there = next_is(r, text);
    r->at += there;
    return there;
}

// Skips the words up to and including the closing bracket of an opening bracket that was already read.
static void skip_to(struct declaration_parser *r, const char *open, const char *close)
{
    for (int depth = 1; r->at < r->d->word_count && depth > 0; r->at++)
        depth += next_is(r, open) - next_is(r, close);
}

// Returns the slot of a word or, if the word is new, the empty slot for it.
static int *slot_of(const struct declarations *d, const char *text)
{
    for (uint32_t at = word_hash(text);; at++) {
        int *slot = &d->slots[at & (uint32_t)(d->slot_count - 1)];
        if (!*slot || strcmp(d->words[*slot - 1].text, text) == 0)
            return slot;
    }
}

// Returns the first word that equals a text, or NULL if there is none.
static struct word *first_of(const struct declarations *d, const char *text)
{
    int index = *slot_of(d, text);
    return index ? &d->words[index - 1] : NULL;
}

// Parses [N], [] or nothing. If the size is a name, `const int NAME = N` is looked up.
static int read_count(struct declaration_parser *r)
{
    int count = 0;
    while (take(r, "[")) {
        int n = -1;
        const char *size = word_at(r, 0);
        const struct word *named = first_of(r->d, size);
        if (isdigit((unsigned char)size[0]) && strcmp(word_at(r, 1), "]") == 0)
            n = atoi(size);
        else if (named && named->constant)
            n = atoi(r->d->words[named->constant].text);
        skip_to(r, "[", "]");
        if (count == 0)
            count = n > 0 ? n : -1;
    }
    return count;
}

static bool is_qualifier(const char *w)
{
    static const char *const words[] = {"highp",    "mediump",   "lowp",    "smooth", "noperspective",
                                        "centroid", "invariant", "precise", "const"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(w, words[i]) == 0)
            return true;
    return false;
}

static bool add_declaration(struct declarations *d, const struct declaration *item)
{
    if (d->count >= MAX_DECLARATIONS) {
        d->cut = true;
        return true;
    }
    if ((d->count & (d->count - 1)) == 0) {
        size_t capacity = d->count ? 2 * (size_t)d->count : 1;
        struct declaration *items = realloc(d->items, capacity * sizeof *items);
        if (!items)
            return false;
        d->items = items;
    }
    d->items[d->count++] = *item;
    return true;
}

// Adds a declared name; if its type is a struct of the source, adds each of its members.
static bool add_expanded(struct declaration_parser *r, const struct declaration *item)
{
    for (int s = 0; s < r->struct_type_count; s++)
        if (strcmp(r->struct_types[s].name, item->type) == 0) {
            for (int m = 0; m < r->struct_types[s].count; m++) {
                struct declaration member = r->members[r->struct_types[s].first + m];
                char name[200];
                snprintf(name, sizeof name, "%.60s%s.%.40s", item->name, item->count ? "[]" : "", member.name);
                snprintf(member.name, sizeof member.name, "%.95s", name);
                member.kind = item->kind;
                member.count = item->count;
                member.line = item->line;
                if (!add_declaration(r->d, &member))
                    return false;
            }
            return true;
        }
    return add_declaration(r->d, item);
}

// Parses name [count] {, name [count]} ;
static bool read_names(struct declaration_parser *r, struct declaration item, bool as_members)
{
    while (word_is_name(word_at(r, 0))) {
        item.line = r->d->words[r->at].line;
        snprintf(item.name, sizeof item.name, "%s", word_at(r, 0));
        r->at++;
        item.count = read_count(r);
        if (as_members) {
            if (r->member_count < MAX_MEMBERS)
                r->members[r->member_count++] = item;
        } else if (!add_expanded(r, &item)) {
            return false;
        }
        while (r->at < r->d->word_count && !next_is(r, ",") && !next_is(r, ";") && !next_is(r, "}"))
            r->at++; // an initialiser
        if (!take(r, ","))
            break;
    }
    take(r, ";");
    return true;
}

// Parses a struct after the keyword `struct`, and stores the struct's name. For an unnamed struct, makes a unique name.
static void read_struct(struct declaration_parser *r, char name[32])
{
    struct struct_type shape = {.first = r->member_count};
    if (next_is(r, "{"))
        snprintf(name, 32, "{%d", r->struct_type_count);
    else
        snprintf(name, 32, "%.31s", r->d->words[r->at++].text);
    snprintf(shape.name, sizeof shape.name, "%s", name);
    if (!take(r, "{"))
        return;
    while (r->at < r->d->word_count && !take(r, "}")) {
        while (is_qualifier(word_at(r, 0)))
            r->at++;
        struct declaration member = {.kind = DECLARED_UNIFORM};
        snprintf(member.type, sizeof member.type, "%.31s", word_at(r, 0));
        r->at++;
        int before = r->at;
        read_names(r, member, true);
        if (r->at == before)
            r->at++;
    }
    shape.count = r->member_count - shape.first;
    if (r->struct_type_count < MAX_STRUCT_TYPES)
        r->struct_types[r->struct_type_count++] = shape;
}

// Parses the rest of a uniform, in or out block after the block's name: `{ members } instance;`, where the instance is
// optional.
static bool read_block(struct declaration_parser *r, enum declared kind)
{
    struct declaration member = {.kind = kind, .in_block = true};
    while (r->at < r->d->word_count && !take(r, "}")) {
        while (is_qualifier(word_at(r, 0)))
            r->at++;
        snprintf(member.type, sizeof member.type, "%.31s", word_at(r, 0));
        r->at++;
        int before = r->at;
        if (!read_names(r, member, false))
            return false;
        if (r->at == before)
            r->at++;
    }
    return true;
}

static bool read_statement(struct declaration_parser *r)
{
    struct declaration item = {.kind = -1};
    for (; r->at < r->d->word_count; r->at++) {
        if (next_is(r, "layout") && strcmp(word_at(r, 1), "(") == 0) {
            r->at += 2;
            skip_to(r, "(", ")");
            r->at--;
        } else if (next_is(r, "flat")) {
            item.flat = true;
        } else if (next_is(r, "uniform")) {
            item.kind = DECLARED_UNIFORM;
        } else if (next_is(r, "in") || next_is(r, "attribute")) {
            item.kind = DECLARED_INPUT;
        } else if (next_is(r, "out")) {
            item.kind = DECLARED_OUTPUT;
        } else if (next_is(r, "varying")) {
            item.kind = r->vertex ? DECLARED_OUTPUT : DECLARED_INPUT;
        } else if (!is_qualifier(word_at(r, 0))) {
            break;
        }
    }
    if (r->at + 1 < r->d->word_count && take(r, "struct")) {
        read_struct(r, item.type);
        if ((int)item.kind >= 0)
            return read_names(r, item, false);
    } else if ((int)item.kind >= 0 && strcmp(word_at(r, 1), "{") == 0) {
        r->at += 2;
        if (!read_block(r, item.kind))
            return false;
    } else if ((int)item.kind >= 0) {
        snprintf(item.type, sizeof item.type, "%.31s", word_at(r, 0));
        r->at++;
        return read_names(r, item, false);
    }
    // Skips other statements: a function, a constant, a precision statement.
    while (r->at < r->d->word_count && !next_is(r, ";") && !next_is(r, "{"))
        r->at++;
    if (take(r, "{"))
        skip_to(r, "{", "}");
    else
        r->at++;
    return true;
}

// Counts equal words in advance, so that a source with many names does not take quadratic time.
static bool count_words(struct declarations *d)
{
    d->slot_count = 16;
    while (d->slot_count < 2 * d->word_count)
        d->slot_count *= 2;
    d->slots = calloc((size_t)d->slot_count, sizeof *d->slots);
    if (!d->slots)
        return false;
    for (int i = 0; i < d->word_count; i++) {
        d->words[i].times = d->words[i].declared = d->words[i].constant = 0;
        int *slot = slot_of(d, d->words[i].text);
        *slot = *slot ? *slot : i + 1;
        d->words[*slot - 1].times++;
        if (word_is(d, i - 1, "int") && word_is(d, i + 1, "=") && i + 2 < d->word_count)
            d->words[*slot - 1].constant = i + 2;
    }
    return true;
}

static bool count_declared(struct declarations *d)
{
    for (int i = 0; i < d->count; i++) {
        struct word *first = first_of(d, d->items[i].name);
        if (first)
            first->declared++;
    }
    return true;
}

bool declarations_read(struct declarations *d, const char *text, bool vertex, lam_error *error)
{
    *d = (struct declarations){0};
    struct declaration_parser *r = calloc(1, sizeof *r);
    bool ok = r && preprocess(d, text) && count_words(d);
    if (r) {
        r->d = d;
        r->vertex = vertex;
    }
    while (ok && r->at < d->word_count)
        ok = read_statement(r);
    ok = ok && count_declared(d);
    free(r);
    if (!ok) {
        declarations_free(d);
        return fail_memory(error, strlen(text));
    }
    return true;
}

void declarations_free(struct declarations *d)
{
    free(d->items);
    free(d->words);
    free(d->slots);
    *d = (struct declarations){0};
}

void declarations_pack(const struct declarations *d, struct text *out)
{
    text_add_part(out, (const char *)d, sizeof *d);
    text_add_part(out, (const char *)d->items, (size_t)d->count * sizeof *d->items);
    text_add_part(out, (const char *)d->words, (size_t)d->word_count * sizeof *d->words);
}

// Returns a copy of the next `count` elements, or NULL if there are fewer or memory runs out.
static void *unpack(const char **at, const char *end, int count, int limit, size_t size)
{
    size_t bytes = (size_t)count * size;
    void *out = count >= 0 && count <= limit && bytes <= (size_t)(end - *at) ? malloc(bytes + 1) : NULL;
    if (out)
        memcpy(out, *at, bytes);
    *at += out ? bytes : 0;
    return out;
}

bool declarations_unpack(struct declarations *d, const char **at, const char *end)
{
    struct declarations *head = unpack(at, end, 1, 1, sizeof *head);
    *d = (struct declarations){0};
    if (!head)
        return false;
    d->version = head->version;
    d->cut = head->cut;
    snprintf(d->profile, sizeof d->profile, "%.15s", head->profile);
    d->items = unpack(at, end, head->count, MAX_DECLARATIONS, sizeof *d->items);
    d->words = unpack(at, end, head->word_count, MAX_WORDS, sizeof *d->words);
    d->count = d->items ? head->count : 0;
    d->word_count = d->words ? head->word_count : 0;
    free(head);
    for (int i = 0; i < d->count; i++)
        d->items[i].type[sizeof d->items->type - 1] = d->items[i].name[sizeof d->items->name - 1] = 0;
    for (int i = 0; i < d->word_count; i++)
        d->words[i].text[sizeof d->words->text - 1] = d->words[i].number[sizeof d->words->number - 1] = 0;
    return d->items && d->words && count_words(d) && count_declared(d);
}

bool declarations_uses(const struct declarations *d, const char *name)
{
    const struct word *first = d->slots ? first_of(d, name) : NULL;
    return first && first->times > first->declared;
}

int declarations_read_elements(const struct declarations *vertex, const struct declarations *fragment, const char *name,
                               int count)
{
    const struct declarations *sides[] = {vertex, fragment};
    size_t length = strcspn(name, "[.");
    int most = 0;
    for (int s = 0; s < 2; s++)
        for (int i = 0; i + 2 < sides[s]->word_count; i++) {
            const struct word *w = &sides[s]->words[i];
            if (strncmp(w->text, name, length) != 0 || w->text[length] || w->depth == 0 || w->is_member)
                continue;
            if (strcmp(w[1].text, "[") != 0 || strchr("0123456789", w[2].text[0]) == NULL)
                return count;
            int index = 0;
            sscanf(w[2].text, "%d", &index);
            if (index >= count)
                return count;
            most = index >= most ? index + 1 : most;
        }
    return most ? most : count;
}

const struct declaration *declarations_find(const struct declarations *d, enum declared kind, const char *name)
{
    for (int i = 0; i < d->count; i++)
        if (d->items[i].kind == kind && strcmp(d->items[i].name, name) == 0)
            return &d->items[i];
    return NULL;
}

bool word_is(const struct declarations *d, int i, const char *text)
{
    return i >= 0 && i < d->word_count && strcmp(d->words[i].text, text) == 0;
}

bool word_take_number(const struct declarations *d, int *at, double *out)
{
    bool minus = word_is(d, *at, "-");
    const char *text = *at + minus < d->word_count ? d->words[*at + minus].text : "";
    size_t length = strcspn(text, "fF");
    const uint8_t *end = (const uint8_t *)text + length;
    if (!length || !strchr("0123456789.", text[0]) || number_double((const uint8_t *)text, end, out) != end)
        return false;
    *out = minus ? -*out : *out;
    *at += minus + 1;
    return true;
}
