// recognise.c: compares the names of a program with the names of each contract.
#include "prefix.h"

#include <stdio.h>
#include <string.h>

#include "name_similarity.h"

// Returns points for a declared name: a name of the contract scores more than an accepted synonym, and a name with a
// different type scores slightly less.
static int points_of(const struct contract *contract, const struct declaration *item, bool attribute)
{
    const struct contract_name *n = contract_find(contract, item->name, attribute, NULL);
    if (!n)
        return -1;
    bool other = strcmp(n->name, item->name) != 0;
    return 8 - (other ? 1 : 0) - (strcmp(n->type, item->type) != 0 ? 2 : 0);
}

static int score(const struct contract *contract, const struct declarations *d, bool vertex)
{
    int points = 0;
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        const char *member = strrchr(item->name, '.');
        bool used = declarations_uses(d, member ? member + 1 : item->name) || member;
        if (!used || (item->kind != DECLARED_UNIFORM && item->kind != DECLARED_INPUT))
            continue;
        if (item->kind == DECLARED_UNIFORM || vertex)
            points += points_of(contract, item, item->kind != DECLARED_UNIFORM);
        else if (contract_varying(contract, item->name))
            points += strlen(item->name) > 1 ? 4 : 1;
    }
    for (const char *const *word = contract->built_ins; *word; word++)
        points += 8 * declarations_uses(d, *word);
    return points;
}

bool contract_recognise(lam_check_contract *const *contracts, int count, struct program_texts *texts,
                        const struct contract **out, lam_error *error)
{
    int best = 0;
    *out = NULL;
    for (int i = 0; i < count; i++) {
        const struct contract *contract = &contracts[i]->contract;
        const struct complete_texts *completed = prefix_texts(texts, contract, error);
        if (!completed)
            return false;
        int points = score(contract, &completed->sides[0], true) + score(contract, &completed->sides[1], false);
        // Contracts with any strengths are skipped. For their shaders, the roles of the names are inferred, and the
        // shaders may use more spaces than a contract describes.
        if (points > best && !contract->any_strengths) {
            best = points;
            *out = contract;
        }
    }
    return true;
}

// --- names that do not match

static const struct declaration *find_uniform_or_attribute(const struct declarations *d, const char *name, bool vertex)
{
    size_t length = strcspn(name, "[");
    for (int i = 0; i < d->count; i++) {
        bool wanted = d->items[i].kind == DECLARED_UNIFORM || (vertex && d->items[i].kind == DECLARED_INPUT);
        if (wanted && strncmp(d->items[i].name, name, length) == 0 && strcspn(d->items[i].name, "[") == length)
            return &d->items[i];
    }
    return NULL;
}

static bool is_declared(const struct contract *contract, const struct contract_name *row,
                        const struct declarations *vertex, const struct declarations *fragment)
{
    const struct declarations *sides[] = {vertex, fragment};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++)
            if (sides[s]->items[i].kind != DECLARED_OUTPUT &&
                contract_find(contract, sides[s]->items[i].name, row->attribute, NULL) == row)
                return true;
    return false;
}

static const struct declaration *find_either(const struct declarations *vertex, const struct declarations *fragment,
                                             const char *name)
{
    const struct declaration *item = find_uniform_or_attribute(vertex, name, true);
    return item ? item : find_uniform_or_attribute(fragment, name, false);
}

// Returns the name in the contract that the author of an unknown name probably meant. Both names have the same kind and
// similar types, and the shaders do not declare the contract's name. Returns NULL if there is none.
static const struct contract_name *meant_by(const struct contract *contract, const struct declarations *vertex,
                                            const struct declarations *fragment, const struct declaration *item)
{
    const struct contract_name *found = NULL;
    double best = 0;
    for (const struct contract_name *n = contract->names; item && n->name; n++) {
        double similarity = name_similarity(item->name, n->name);
        if (n->attribute == (item->kind == DECLARED_INPUT) && strncmp(n->type, item->type, 3) == 0 &&
            similarity > best && similarity >= 0.5 && !is_declared(contract, n, vertex, fragment)) {
            best = similarity;
            found = n;
        }
    }
    return found;
}

bool contract_is_misspelt(const struct contract *contract, const struct declarations *vertex,
                          const struct declarations *fragment, const char *name)
{
    const struct declaration *item = find_either(vertex, fragment, name);
    const struct contract_name *meant = meant_by(contract, vertex, fragment, item);
    return meant && strcmp(meant->type, item->type) == 0 && !name_is_same(item->name, meant->name) &&
           name_similarity(item->name, meant->name) > 0.6;
}

void contract_describe_unknown(const struct contract *contract, const struct declarations *vertex,
                               const struct declarations *fragment, const char *const *unknown, int count, char *out,
                               size_t capacity)
{
    size_t at = 0;
    out[0] = 0;
    for (int i = 0; i < count && at + 120 < capacity; i++) {
        const struct declaration *item = find_either(vertex, fragment, unknown[i]);
        const struct contract_name *meant = meant_by(contract, vertex, fragment, item);
        at += (size_t)snprintf(out + at, capacity - at, "%s'%.40s'", i ? ", " : "", unknown[i]);
        if (item)
            at += (size_t)snprintf(out + at, capacity - at, " (%s%s%s)", item->type, meant ? "; there: " : "",
                                   meant ? meant->name : "");
    }
    if (at + 120 >= capacity)
        snprintf(out + at, capacity - at, " ...");
}
