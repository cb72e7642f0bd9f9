// fault_sets.c: searches for sets of faults that together explain the pictures.
#include "fault_candidate.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { BEAM = 6 };

// The search adds a third fault only if the best two faults leave at most this fraction of the original difference.
static const double max_score_for_a_third = 0.75;
static const double min_gain = 0.03; // each further fault must reduce the score by this much
static const double max_exact =
    2e-4; // an explanation is exact if its mean difference over all scenes is at most this (rounding errors)

// --- several faults

// Removes unnecessary faults, and checks the others: each fault must by itself explain a scene, or the whole set must
// be exact.
static bool reduce(struct state *t, struct candidate *c, lam_error *error)
{
    for (int i = 0; i < c->count && c->count > 1;) {
        struct candidate less = *c;
        memmove(&less.members[i], &less.members[i + 1], (size_t)(c->count - i - 1) * sizeof *less.members);
        less.count--;
        candidate_rebuild(&less);
        if (!candidate_try(t, &less, no_limit, error))
            return false;
        if (less.fits) {
            *c = less;
            i = 0;
        } else {
            i++;
        }
    }
    bool supported = c->mean <= max_ratio_explained * t->s->before;
    for (int i = 0; i < c->count && c->mean > max_exact; i++)
        supported = supported &&
                    (fault_is_style(c->members[i].row, t->s->interface) || outcome_of(t, c->members[i].row)->explained);
    c->fits = c->fits && supported;
    return true;
}

static bool is_better(const struct candidate *a, const struct candidate *b)
{
    return a->fits != b->fits ? a->fits : a->score < b->score - 1e-6; // equal candidates keep the order of the table
}

// Inserts a candidate into the best BEAM candidates, which are sorted.
static void beam_insert(struct candidate beam[BEAM], int *count, const struct candidate *c)
{
    for (int i = 0; i < *count; i++)
        if (fault_set_equal(&beam[i].set, &c->set))
            return;
    int at = *count;
    while (at > 0 && is_better(c, &beam[at - 1]))
        at--;
    if (at == BEAM)
        return;
    int last = *count < BEAM ? (*count)++ : BEAM - 1;
    for (int i = last; i > at; i--)
        beam[i] = beam[i - 1];
    beam[at] = *c;
}

// Adds each fault to each candidate of the beam.
static bool extend(struct state *t, const struct candidate *beam, int beam_count, struct candidate next[BEAM],
                   int *count, lam_error *error)
{
    for (int b = 0; b < beam_count; b++)
        for (int m = 0; m < fault_count && !search_is_spent(t); m++) {
            struct outcome *o = &t->outcomes[m];
            struct candidate c = beam[b];
            fault_set same = fault_set_add(&c.set, &faults[m]);
            if (!o->applies || !o->changed_count || (!faults[m].fit && fault_set_equal(&same, &c.set)))
                continue;
            if (!outcome_find_spoils(t, o, error))
                return false;
            bool possible = !o->spoils;
            if (possible && !candidate_prepare(t, &beam[b].set, &faults[m], &c.members[c.count], &possible, error))
                return false;
            if (!possible)
                continue;
            c.count++;
            candidate_rebuild(&c);
            double max_score = *count == BEAM ? next[BEAM - 1].score : no_limit;
            bool useful;
            if (!candidate_try_child(t, &beam[b], o, &c, max_score, &useful, error))
                return false;
            if (useful)
                beam_insert(next, count, &c);
        }
    return true;
}

// Tries five forms that hide each other, so that no set of two explains much, alone and with one more fault. If one of the
// forms is impossible, the search of small sets suffices, and costs less.
static bool try_common(struct state *t, struct candidate *best, lam_error *error)
{
    static const char *const ids[] = {"no-gate", "normal-unit-late", "alpha-summed", "distance-interpolated",
                                      "direction-minus-point"};
    enum { IDS = sizeof ids / sizeof *ids };
    struct candidate set = {0}, next[BEAM];
    for (int i = 0; i < IDS; i++)
        for (int m = 0; m < fault_count && set.count == i; m++)
            if (strcmp(faults[m].id, ids[i]) == 0 && t->outcomes[m].applies && t->outcomes[m].changed_count)
                set.members[set.count++] = t->outcomes[m].fault;
    candidate_rebuild(&set);
    int more = 0;
    if (set.count < IDS)
        return true;
    if (!candidate_try(t, &set, no_limit, error) || (!set.fits && !extend(t, &set, 1, next, &more, error)))
        return false;
    set = more ? next[0] : set;
    if (!set.fits)
        return true;
    *best = set;
    return reduce(t, best, error);
}

bool sets_try(struct state *t, struct candidate *best, lam_error *error)
{
    if (!try_common(t, best, error))
        return false;
    if (best->fits)
        return true;
    struct candidate beam[BEAM];
    int beam_count = 0;
    for (int m = 0; m < fault_count; m++) {
        struct outcome *o = &t->outcomes[m];
        if (!o->applies || (o->spoils_known && o->spoils))
            continue;
        struct candidate c = {.members = {o->fault}, .count = 1, .mean = o->mean, .score = o->score};
        memcpy(c.parts, o->parts, sizeof c.parts);
        candidate_rebuild(&c);
        // A candidate that spoils a scene cannot be part of an explanation, so it must not displace another candidate.
        bool near = beam_count < BEAM || is_better(&c, &beam[BEAM - 1]);
        if (near && !outcome_find_spoils(t, o, error))
            return false;
        if (near && !o->spoils)
            beam_insert(beam, &beam_count, &c);
    }
    for (int depth = 2; depth <= MAX_FOUND_FAULTS && beam_count > 0; depth++) {
        struct candidate next[BEAM];
        int count = 0;
        double before = beam[0].score;
        if (!extend(t, beam, beam_count, next, &count, error))
            return false;
        for (int i = 0; i < count && next[i].fits && !best->fits; i++) {
            if (!reduce(t, &next[i], error))
                return false;
            if (next[i].fits)
                *best = next[i];
        }
        // Stops if a further fault would hardly reduce the score.
        if (best->fits || count == 0 || next[0].score > before - min_gain || next[0].score > max_score_for_a_third)
            break;
        memcpy(beam, next, sizeof beam);
        beam_count = count;
    }
    return true;
}
