// fault_candidate.c: measures sets of faults, scene by scene, and stops as soon as a set cannot succeed.
#include "fault_candidate.h"

#include <string.h>

enum { IDLE_SCENES = 4 };

// the last fault of a set must improve at least one scene by this much
static const double min_idle_gain = 0.001;

// Returns whether faults cause a difference in a scene that passes without faults.
static bool candidate_is_spoilt(const struct state *t, int index, const struct difference *d)
{
    const struct difference *without = &t->without[index];
    return !d->fits && (without->fits || d->mean > 1.5 * without->mean);
}

bool search_is_spent(struct state *t)
{
    t->s->stopped = t->s->stopped || t->m.pictures >= t->s->max_pictures;
    return t->s->stopped;
}

double candidate_score_of(const struct state *t, int index, const struct difference *d)
{
    const struct scene_comparison *scene = &t->m.scenes[index];
    double left = scene->passes ? candidate_is_spoilt(t, index, d) : d->mean / scene->mean_difference;
    return (left < 1 ? left : 1) / t->m.differ_count;
}

// Measures a candidate in scene `index`, and adds the result.
static bool add_scene(struct state *t, struct candidate *c, int index, lam_error *error)
{
    struct difference d;
    if (!fault_measure_scene(&t->m, index, &c->set, &d, error))
        return false;
    c->parts[index] = candidate_score_of(t, index, &d);
    c->mean += d.mean / t->m.scene_count;
    c->score += c->parts[index];
    c->fits = c->fits && d.fits;
    return true;
}

static void start(struct candidate *c)
{
    c->mean = c->score = 0;
    c->fits = true;
}

bool candidate_try(struct state *t, struct candidate *c, double max_mean, lam_error *error)
{
    start(c);
    for (int k = 0; k < t->m.scene_count; k++) {
        if (!add_scene(t, c, t->m.order[k], error))
            return false;
        if (c->mean > max_mean) {
            c->fits = false;
            break;
        }
    }
    return true;
}

// The parent of a candidate is the set without the last fault. Returns whether, in the first `count` scenes that the
// last fault changes, the candidate explains hardly more than its parent. The search then drops the candidate.
static bool is_idle(const struct state *t, const struct candidate *c, const struct candidate *parent, const int *order,
                    int count)
{
    double gained = 0;
    for (int k = 0; k < count; k++)
        gained += parent->parts[order[k]] - c->parts[order[k]];
    return gained < min_idle_gain * count / t->m.differ_count;
}

bool candidate_try_child(struct state *t, const struct candidate *parent, const struct outcome *o, struct candidate *c,
                         double max_score, bool *useful, lam_error *error)
{
    int first = o->changed_count < IDLE_SCENES ? o->changed_count : IDLE_SCENES;
    start(c);
    t->s->tried++;
    *useful = first > 0;
    for (int k = 0; k < t->m.scene_count && *useful; k++) {
        if (!add_scene(t, c, o->order[k], error))
            return false;
        *useful = c->score <= max_score && !(k + 1 == first && is_idle(t, c, parent, o->order, first));
    }
    return true;
}

void candidate_rebuild(struct candidate *c)
{
    c->set = (fault_set){0};
    for (int i = 0; i < c->count; i++)
        c->set = fault_measure_with(&c->set, &c->members[i]);
}

bool candidate_prepare(struct state *t, const fault_set *base, const struct fault *row, struct found_fault *out,
                       bool *possible, lam_error *error)
{
    *out = (struct found_fault){.row = row};
    *possible = true;
    if (!row->fit && !(row->factor > 0 && (base->factor > 0 || base->constant > 0)))
        return true;
    *possible = base->factor == 0 && base->constant == 0; // the exponent can be changed only once
    if (!*possible || !row->fit)
        return true;
    bool ok = fault_measure_fit(&t->m, base, row, &out->exponent, error);
    *possible = out->exponent > 0;
    return ok;
}

bool outcome_find_spoils(struct state *t, struct outcome *o, lam_error *error)
{
    if (o->spoils_known)
        return true;
    const fault_set none = {0};
    struct found_fault fault = o->fault;
    if (fault.row->fit) // the fitted number may differ in combination with another fault
        fault.exponent = fault.row->fit == FIT_SMALLER ? 0.5f : 2;
    fault_set set = fault_measure_with(&none, &fault);
    for (int k = t->m.differ_count; k < t->m.scene_count && !o->spoils; k++) {
        struct difference d;
        if (!fault_measure_scene(&t->m, t->m.order[k], &set, &d, error))
            return false;
        o->spoils = candidate_is_spoilt(t, t->m.order[k], &d);
    }
    o->spoils_known = true;
    return true;
}

struct outcome *outcome_of(const struct state *t, const struct fault *row) { return &t->outcomes[row - faults]; }
