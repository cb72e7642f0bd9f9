// recognise.c: compares the names of a program with the names of each contract.
#include "prefix.h"

#include <stdio.h>
#include <string.h>

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
