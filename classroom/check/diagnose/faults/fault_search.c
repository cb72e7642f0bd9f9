// fault_search.c: searches for the faults that explain the pictures.
//
// The search first tries each fault alone, up to the first scene that the fault does not explain. A beam search then adds
// one more fault to each of the best few sets. If no set explains
// every picture, only a fault that explains nearly all of the difference is reported.
//
// Nearly all of the time is spent drawing, so hopeless sets are abandoned after few pictures: an added fault must
// improve the first scenes that it changes (is_idle). The search stops when it reaches its limit of pictures. The limit
// includes cached pictures, so that the result does not depend on the cache.
#include "fault_candidate.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

// Two pictures are equal if their mean difference is at most this.
static const double same_mean = 1e-5;
// If no set explains every picture, a fault is reported that leaves at most this fraction of the difference.
static const double max_left = 0.05;
// A fault changes a scene if, applied alone, it changes the scene's mean difference by at least this much.
static const double min_change = 1e-6;

// --- one fault

static bool explains(const struct scene_comparison *scene, const struct difference *d)
{
    return d->fits && d->mean <= max_ratio_explained * scene->mean_difference;
}

// Measures every scene with no fault switched on.
static bool measure_without(struct state *t, lam_error *error)
{
    const fault_set none = {0};
    bool ok = true;
    for (int k = 0; ok && k < t->m.scene_count; k++)
        ok = fault_measure_scene(&t->m, t->m.order[k], &none, &t->without[t->m.order[k]], error);
    return ok;
}

// Orders the scenes for sets that contain a fault: the scenes that the fault changes most come first.
static void order_by_change(const struct state *t, struct outcome *o)
{
    memcpy(o->order, t->m.order, sizeof o->order);
    o->changed_count = 0;
    for (int k = 0; k < t->m.differ_count; k++) {
        int scene = t->m.order[k], at = k;
        o->changed_count += o->changes[scene] > min_change;
        for (; at > 0 && o->changes[o->order[at - 1]] < o->changes[scene]; at--)
            o->order[at] = o->order[at - 1];
        o->order[at] = scene;
    }
}

// Measures a fault alone in the differing scenes that are not measured yet. With `all`, continues after a scene that
// the fault does not explain.
static bool measure_outcome(struct state *t, struct outcome *o, bool all, lam_error *error)
{
    const fault_set none = {0};
    fault_set set = fault_measure_with(&none, &o->fault);
    for (; o->measured < t->m.differ_count && (all || o->fits); o->measured++) {
        struct difference d;
        int i = t->m.order[o->measured];
        if (!fault_measure_scene(&t->m, i, &set, &d, error))
            return false;
        double change = d.mean - t->without[i].mean;
        o->changes[i] = (change < 0 ? -change : change) / t->m.scenes[i].mean_difference;
        o->mean += d.mean / t->m.scene_count;
        o->parts[i] = candidate_score_of(t, i, &d);
        o->score += o->parts[i];
        o->fits = o->fits && d.fits;
        if (explains(&t->m.scenes[i], &d))
            o->explained |= (uint32_t)1 << i;
    }
    return true;
}

// Tries each fault of the table alone, up to the first scene that the fault does not explain. `best` receives the best
// fault that explains everything.
static bool try_each(struct state *t, struct candidate *best, lam_error *error)
{
    struct fault_search *s = t->s;
    const fault_set none = {0};
    if (!measure_without(t, error))
        return false;
    for (int m = 0; m < fault_count && !search_is_spent(t); m++) {
        struct outcome *o = &t->outcomes[m];
        bool exact = best->fits && best->mean <= same_mean; // fitting a number cannot improve an exact explanation
        // A fault that removes a whole term is not tried if inputs without values may remove the term; the report
        // already mentions these inputs.
        o->applies = fault_applies(&faults[m], s->interface, s->frame, s->reflection, s->needs) &&
                     !(faults[m].whole_term && s->has_unset_names) && !(faults[m].fit && exact);
        if (o->applies && !candidate_prepare(t, &none, &faults[m], &o->fault, &o->applies, error))
            return false;
        if (!o->applies)
            continue;
        t->s->tried++;
        o->fits = true;
        if (!measure_outcome(t, o, false, error))
            return false;
        struct candidate c = {.members = {o->fault}, .count = 1, .set = fault_measure_with(&none, &o->fault)};
        if (!o->fits)
            continue;
        if (!candidate_try(t, &c, no_limit, error))
            return false;
        // If several faults draw equal pictures, the first of them in the table is used.
        if (c.fits && c.mean <= max_ratio_explained * s->before &&
            (!best->fits || c.mean < 0.5 * best->mean - same_mean))
            *best = c;
    }
    return true;
}

// Measures each fault alone in the remaining scenes, because the search for sets needs these results.
static bool complete_each(struct state *t, lam_error *error)
{
    for (int m = 0; m < fault_count && !search_is_spent(t); m++) {
        struct outcome *o = &t->outcomes[m];
        if (o->applies && !measure_outcome(t, o, true, error))
            return false;
        order_by_change(t, o);
    }
    return true;
}

// Tries the sets of accepted forms that a contract may forbid. The search tries these sets before any mistake, because
// accepted forms often occur together.
static bool try_forms(struct state *t, struct candidate *best, lam_error *error)
{
    struct found_fault forms[MAX_FOUND_FAULTS];
    int count = 0;
    for (int m = 0; m < fault_count && count < MAX_FOUND_FAULTS; m++)
        if (faults[m].demand && fault_is_style(&faults[m], t->s->interface) &&
            fault_applies(&faults[m], t->s->interface, t->s->frame, t->s->reflection, t->s->needs))
            forms[count++] = (struct found_fault){.row = &faults[m]};
    for (unsigned some = 1; some < 1u << count && !best->fits; some++) {
        struct candidate c = {0};
        for (int i = 0; i < count; i++)
            if (some >> i & 1)
                c.members[c.count++] = forms[i];
        candidate_rebuild(&c);
        t->s->tried++;
        if (!candidate_try(t, &c, max_ratio_explained * t->s->before, error))
            return false;
        if (c.fits)
            *best = c;
    }
    return true;
}

// --- the result

// Finds the faults that draw the same pictures as member `i` of a complete explanation.
static bool find_also(struct state *t, const struct candidate *best, int i, struct found_fault *found, lam_error *error)
{
    for (int m = 0; m < fault_count && found->also_count < MAX_ALSO; m++) {
        struct outcome *o = &t->outcomes[m];
        if (!o->applies || fault_is_style(&faults[m], t->s->interface) || faults[m].rare || faults[m].fit ||
            strcmp(faults[m].id, found->row->id) == 0 || (m > 0 && strcmp(faults[m].id, faults[m - 1].id) == 0))
            continue;
        double most = 2 * best->mean + same_mean;
        if (best->count == 1 && (!o->fits || o->mean > most))
            continue;
        struct candidate c = *best;
        c.members[i] = o->fault;
        candidate_rebuild(&c);
        if (fault_set_equal(&c.set, &best->set))
            continue;
        if (!candidate_try(t, &c, most, error))
            return false;
        if (c.fits)
            found->also[found->also_count++] = &faults[m];
    }
    return true;
}

// Stores a candidate as the result, beginning with the fault that explains most.
static bool store(struct state *t, struct candidate *c, lam_error *error)
{
    struct fault_search *s = t->s;
    for (int i = 1; i < c->count; i++)
        for (int k = i; k > 0 && outcome_of(t, c->members[k].row)->mean < outcome_of(t, c->members[k - 1].row)->mean;
             k--) {
            struct found_fault kept = c->members[k];
            c->members[k] = c->members[k - 1];
            c->members[k - 1] = kept;
        }
    s->certain = c->fits;
    struct candidate part = {0};
    for (int i = 0; i < c->count; i++) {
        part.members[part.count++] = c->members[i];
        candidate_rebuild(&part);
        if (!candidate_try(t, &part, no_limit, error))
            return false;
        if (fault_is_style(c->members[i].row, s->interface)) {
            s->styles[s->style_count++] = c->members[i].row;
            continue;
        }
        struct found_fault *found = &s->found[s->count++];
        *found = c->members[i];
        found->after = part.mean;
        if (s->certain && !find_also(t, c, i, found, error))
            return false;
    }
    for (int i = 0; i < s->scene_count; i++) {
        s->scene_faults[i] = NULL;
        for (int k = 0; k < s->count && !s->scene_faults[i]; k++)
            if (outcome_of(t, s->found[k].row)->explained >> i & 1)
                s->scene_faults[i] = s->found[k].row;
    }
    return true;
}

static bool search(struct state *t, lam_error *error)
{
    struct candidate best = {0};
    if (!try_forms(t, &best, error))
        return false;
    if (best.fits)
        return store(t, &best, error);
    if (!try_each(t, &best, error))
        return false;
    if (!best.fits && !complete_each(t, error))
        return false;
    if (!best.fits && !t->s->has_unset_names && !sets_try(t, &best, error))
        return false;
    const struct outcome *nearest = NULL;
    for (int m = 0; m < fault_count && !best.fits && !t->s->has_unset_names; m++)
        if (t->outcomes[m].applies && (!nearest || t->outcomes[m].mean < nearest->mean) &&
            !fault_is_style(&faults[m], t->s->interface))
            nearest = &t->outcomes[m];
    if (nearest && !nearest->spoils && nearest->mean <= max_left * t->s->before)
        best = (struct candidate){.members = {nearest->fault}, .count = 1};
    return !best.count || store(t, &best, error);
}

bool fault_search_run(struct fault_search *s, lam_error *error)
{
    struct state t = {.s = s, .outcomes = calloc((size_t)fault_count, sizeof *t.outcomes)};
    bool ok = t.outcomes || fail_memory(error, (size_t)fault_count * sizeof *t.outcomes);
    if (ok && (ok = fault_measure_open(&t.m, s, error))) {
        ok = search(&t, error);
        fault_measure_close(&t.m);
    }
    free(t.outcomes);
    return ok;
}

bool fault_search_draw_style(struct fault_search *s, int scene, float *pixels, lam_error *error)
{
    struct fault_measure m = {.s = s, .scenes = s->scenes, .stride = 1, .size = s->size};
    const fault_set none = {0};
    fault_set set = none;
    for (int i = 0; i < s->style_count; i++)
        set = fault_set_add(&set, s->styles[i]);
    bool ok = fault_measure_draw(&m, scene, &set, pixels, error);
    render_cache_keep_shader(s->cache, m.shader);
    return ok;
}
