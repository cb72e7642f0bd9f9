// fault_search.c: the search for the faults that explain the pictures.
//
// 1. Each fault alone. 2. Together, those that explain scenes of their own. 3. A beam search: each of the best few with
// one more fault, and so on. 4. If no set explains every picture: the faults that explain some, and spoil none.
//
// Nearly all of the time goes into drawing, so few pictures are drawn of a set that leads nowhere: the added fault must
// gain in the first of the scenes that it changes (is_idle). The search ends at its limit of pictures; they are counted
// whether they come from the cache or not, so that the result does not depend on it.
#include "fault_measure.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { BEAM = 6, IDLE_SCENES = 4 };

// As fractions of the difference without faults:
static const double max_ratio_explained = 0.125;  // may remain of a scene, or of all, that is explained
static const double max_score_for_a_third = 0.75; // may remain after two faults for a search of three to be worthwhile
static const double min_gain = 0.03;              // each fault more must explain
static const double min_idle_gain = 0.001;        // of one set over another with a fault less, in some scenes
static const double max_rival = 1.25;             // times as much a rival may leave over all scenes
// As mean differences: what rounding leaves of an exact explanation, over all scenes and in one; and the difference
// between the same pictures.
static const double max_exact = 2e-4, max_exact_scene = 1e-4, same_mean = 1e-5;
static const double no_limit = 1e9;
// The least change of a scene's mean difference, by one fault alone, that counts as a change of the scene.
static const double min_change = 1e-6;

// A set of faults, and the difference that it leaves.
struct candidate {
    struct found_fault members[MAX_FOUND_FAULTS];
    int count;
    fault_set set;
    double mean;  // over all scenes
    double score; // what it leaves of the difference of each scene, on average: 1 is all, so small highlights count too
    bool fits;
    double parts[MAX_SCENES]; // of the score: what each scene adds to it
};

// What a fault does alone.
struct outcome {
    struct found_fault fault;
    double mean, score;       // as of a candidate
    double parts[MAX_SCENES]; // likewise, of the scenes that differ
    int order[MAX_SCENES];    // the scenes: those that differ first, and of these the ones that it changes most
    int changed_count;        // how many of those that differ it changes
    uint32_t explained;       // the scenes that differ and that it explains
    uint32_t exactly;         // those of them that it explains but for rounding
    bool applies, spoils_known, spoils;
};

struct state {
    struct fault_search *s;
    struct fault_measure m;
    struct outcome *outcomes; // of each row of the table
    // Each scene without faults, in the measured pixels. Of so few, more than the tolerated ones of a scene that passes may
    // differ.
    struct difference without[MAX_SCENES];
};

// Whether a difference in a scene that passes without faults is one that the faults make.
static bool is_spoilt(const struct state *t, int index, const struct difference *d)
{
    const struct difference *without = &t->without[index];
    return !d->fits && (without->fits || d->mean > 1.5 * without->mean);
}

// Whether the search has drawn as many pictures as it may.
static bool is_spent(struct state *t)
{
    t->s->stopped = t->s->stopped || t->m.pictures >= t->s->max_pictures;
    return t->s->stopped;
}

// The part of a candidate's score that comes from one scene. A scene that gets worse counts as one without faults: where
// several faults act, one of them alone may well spoil it.
static double score_of(const struct state *t, int index, const struct difference *d)
{
    const struct scene_comparison *scene = &t->m.scenes[index];
    double left = scene->passes ? is_spoilt(t, index, d) : d->mean / scene->mean_difference;
    return (left < 1 ? left : 1) / t->m.differ_count;
}

// Measures a candidate in scene `index`, and adds the result.
static bool add_scene(struct state *t, struct candidate *c, int index, lam_error *error)
{
    struct difference d;
    if (!fault_measure_scene(&t->m, index, &c->set, &d, error))
        return false;
    c->parts[index] = score_of(t, index, &d);
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

// Measures a candidate in all scenes. Stops as soon as its mean exceeds its limit.
static bool try_candidate(struct state *t, struct candidate *c, double max_mean, lam_error *error)
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

// Whether a candidate leaves as much as its parent, which lacks the last fault, of the first `count` scenes that this fault
// changes: it leads nowhere.
static bool is_idle(const struct state *t, const struct candidate *c, const struct candidate *parent, const int *order,
                    int count)
{
    double gained = 0;
    for (int k = 0; k < count; k++)
        gained += parent->parts[order[k]] - c->parts[order[k]];
    return gained < min_idle_gain * count / t->m.differ_count;
}

// Measures a parent with one more fault, alone known as `o`. `useful`: its score is within the limit, and less than its
// parent's.
static bool try_child(struct state *t, const struct candidate *parent, const struct outcome *o, struct candidate *c,
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

static void rebuild(struct candidate *c)
{
    c->set = (fault_set){0};
    for (int i = 0; i < c->count; i++)
        c->set = fault_measure_with(&c->set, &c->members[i]);
}

// Completes a member to be added to a set. False: an error. `possible`: whether it can be added.
static bool prepare_member(struct state *t, const fault_set *base, const struct fault *row, struct found_fault *out,
                           bool *possible, lam_error *error)
{
    *out = (struct found_fault){.row = row};
    *possible = true;
    if (!row->fit && !(row->factor > 0 && (base->factor > 0 || base->constant > 0)))
        return true;
    *possible = base->factor == 0 && base->constant == 0; // one change of the exponent
    if (!*possible || !row->fit)
        return true;
    bool ok = fault_measure_fit(&t->m, base, row, &out->exponent, error);
    *possible = out->exponent > 0;
    return ok;
}

// --- one fault

static bool explains(const struct scene_comparison *scene, const struct difference *d)
{
    return d->fits && d->mean <= max_ratio_explained * scene->mean_difference;
}

// The scenes without faults.
static bool measure_without(struct state *t, lam_error *error)
{
    const fault_set none = {0};
    bool ok = true;
    for (int k = 0; ok && k < t->m.scene_count; k++)
        ok = fault_measure_scene(&t->m, t->m.order[k], &none, &t->without[t->m.order[k]], error);
    return ok;
}

// Orders the scenes for sets with a fault: `changes` of each scene that differs.
static void order_by_change(const struct state *t, struct outcome *o, const double *changes)
{
    memcpy(o->order, t->m.order, sizeof o->order);
    o->changed_count = 0;
    for (int k = 0; k < t->m.differ_count; k++) {
        int scene = t->m.order[k], at = k;
        o->changed_count += changes[scene] > min_change;
        for (; at > 0 && changes[o->order[at - 1]] < changes[scene]; at--)
            o->order[at] = o->order[at - 1];
        o->order[at] = scene;
    }
}

// Tries each fault of the table alone in the scenes that differ. `best` is the best that explains everything.
static bool try_each(struct state *t, struct candidate *best, lam_error *error)
{
    struct fault_search *s = t->s;
    const fault_set none = {0};
    if (!measure_without(t, error))
        return false;
    for (int m = 0; m < fault_count && !is_spent(t); m++) {
        struct outcome *o = &t->outcomes[m];
        // An input without a value takes a term away just as well, and is reported already.
        o->applies = fault_applies(&faults[m], s->interface, s->frame, s->reflection, s->needs) &&
                     !(faults[m].whole_term && s->has_unset_names);
        if (o->applies && !prepare_member(t, &none, &faults[m], &o->fault, &o->applies, error))
            return false;
        if (!o->applies)
            continue;
        struct candidate c = {.members = {o->fault}, .count = 1, .set = fault_measure_with(&none, &o->fault)};
        bool fits = true;
        double changes[MAX_SCENES] = {0};
        t->s->tried++;
        for (int k = 0; k < t->m.differ_count; k++) {
            struct difference d;
            int i = t->m.order[k];
            if (!fault_measure_scene(&t->m, i, &c.set, &d, error))
                return false;
            double change = d.mean - t->without[i].mean;
            changes[i] = (change < 0 ? -change : change) / t->m.scenes[i].mean_difference;
            o->mean += d.mean / t->m.scene_count;
            o->parts[i] = score_of(t, i, &d);
            o->score += o->parts[i];
            fits = fits && d.fits;
            if (explains(&t->m.scenes[i], &d))
                o->explained |= (uint32_t)1 << i;
            if (explains(&t->m.scenes[i], &d) && d.mean <= max_exact_scene)
                o->exactly |= (uint32_t)1 << i;
        }
        order_by_change(t, o, changes);
        if (!fits)
            continue;
        if (!try_candidate(t, &c, no_limit, error))
            return false;
        // Of faults that draw the same pictures the first in the table is found.
        if (c.fits && c.mean <= max_ratio_explained * s->before &&
            (!best->fits || c.mean < 0.5 * best->mean - same_mean))
            *best = c;
    }
    return true;
}

// Accepted forms that a contract may demand otherwise are frequent together: each set of them is tried before any mistake.
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
        rebuild(&c);
        t->s->tried++;
        if (!try_candidate(t, &c, max_ratio_explained * t->s->before, error))
            return false;
        if (c.fits)
            *best = c;
    }
    return true;
}

// Whether a fault changes a scene that passes without it. A shader that has the fault would not pass there.
static bool find_spoils(struct state *t, struct outcome *o, lam_error *error)
{
    if (o->spoils_known)
        return true;
    const fault_set none = {0};
    struct found_fault fault = o->fault;
    if (fault.row->fit) // with another fault the number may be another
        fault.exponent = fault.row->fit == FIT_SMALLER ? 0.5f : 2;
    fault_set set = fault_measure_with(&none, &fault);
    for (int k = t->m.differ_count; k < t->m.scene_count && !o->spoils; k++) {
        struct difference d;
        if (!fault_measure_scene(&t->m, t->m.order[k], &set, &d, error))
            return false;
        o->spoils = is_spoilt(t, t->m.order[k], &d);
    }
    o->spoils_known = true;
    return true;
}

static struct outcome *outcome_of(const struct state *t, const struct fault *row) { return &t->outcomes[row - faults]; }

static int count_bits(uint32_t bits)
{
    int count = 0;
    for (; bits; bits &= bits - 1)
        count++;
    return count;
}

// --- several faults

// Takes away what is not needed, and checks what is left: each name is supported by a scene that it explains alone, or
// the explanation is exact.
static bool reduce(struct state *t, struct candidate *c, lam_error *error)
{
    for (int i = 0; i < c->count && c->count > 1;) {
        struct candidate less = *c;
        memmove(&less.members[i], &less.members[i + 1], (size_t)(c->count - i - 1) * sizeof *less.members);
        less.count--;
        rebuild(&less);
        if (!try_candidate(t, &less, no_limit, error))
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

// Whether a fault is the one that explains some scene: no other explains it and leaves about as little over all scenes.
static bool is_the_one(struct state *t, const struct outcome *o, lam_error *error, bool *ok)
{
    for (int k = 0; k < t->m.differ_count; k++) {
        uint32_t scene = (uint32_t)1 << t->m.order[k];
        bool alone = (o->exactly & scene) != 0;
        for (int m = 0; alone && m < fault_count; m++) {
            struct outcome *other = &t->outcomes[m];
            if (!(other->explained & scene) || strcmp(faults[m].id, o->fault.row->id) == 0 ||
                other->score > max_rival * o->score)
                continue;
            *ok = *ok && find_spoils(t, other, error);
            alone = *ok && other->spoils;
        }
        if (alone)
            return true;
    }
    return false;
}

// Together, the faults that explain scenes of their own, those that explain most first. `all`: those must explain every
// picture; otherwise, as many as explain further scenes and contradict none.
static bool try_supported(struct state *t, bool all, struct candidate *c, lam_error *error)
{
    struct fault_search *s = t->s;
    uint32_t covered = 0;
    bool *used = calloc((size_t)fault_count, sizeof *used);
    bool ok = used || fail_memory(error, (size_t)fault_count);
    *c = (struct candidate){.mean = s->before, .score = 1};
    while (ok && c->count < MAX_FOUND_FAULTS) {
        struct outcome *next = NULL;
        for (int m = 0; ok && m < fault_count; m++) {
            struct outcome *o = &t->outcomes[m];
            int mine = count_bits(o->explained & ~covered), most = next ? count_bits(next->explained & ~covered) : 0;
            if (used[m] || !mine || fault_is_style(&faults[m], t->s->interface) || mine < most ||
                (mine == most && o->mean >= next->mean))
                continue;
            ok = find_spoils(t, o, error);
            if (ok && !o->spoils && (all || is_the_one(t, o, error, &ok)))
                next = o;
        }
        if (!ok || !next)
            break;
        used[next - t->outcomes] = true;
        struct candidate more = *c;
        more.members[more.count++] = next->fault;
        rebuild(&more);
        s->tried++;
        ok = try_candidate(t, &more, no_limit, error);
        if (all || (ok && more.score < c->score && more.mean < c->mean)) {
            *c = more;
            covered |= next->explained;
        }
    }
    free(used);
    return ok && (!all || !c->fits || reduce(t, c, error));
}

static bool is_better(const struct candidate *a, const struct candidate *b)
{
    return a->fits != b->fits ? a->fits : a->score < b->score - 1e-6; // equal candidates keep the table's order
}

// Inserts a candidate into the best BEAM, which are sorted.
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
        for (int m = 0; m < fault_count && !is_spent(t); m++) {
            struct outcome *o = &t->outcomes[m];
            struct candidate c = beam[b];
            fault_set same = fault_set_add(&c.set, &faults[m]);
            if (!o->applies || !o->changed_count || (!faults[m].fit && fault_set_equal(&same, &c.set)))
                continue;
            if (!find_spoils(t, o, error))
                return false;
            bool possible = !o->spoils;
            if (possible && !prepare_member(t, &beam[b].set, &faults[m], &c.members[c.count], &possible, error))
                return false;
            if (!possible)
                continue;
            c.count++;
            rebuild(&c);
            double max_score = *count == BEAM ? next[BEAM - 1].score : no_limit;
            bool useful;
            if (!try_child(t, &beam[b], o, &c, max_score, &useful, error))
                return false;
            if (useful)
                beam_insert(next, count, &c);
        }
    return true;
}

// The beam search for sets of two, three and four faults.
static bool try_sets(struct state *t, struct candidate *best, lam_error *error)
{
    struct candidate beam[BEAM];
    int beam_count = 0;
    for (int m = 0; m < fault_count; m++) {
        const struct outcome *o = &t->outcomes[m];
        if (!o->applies || (o->spoils_known && o->spoils))
            continue;
        struct candidate c = {.members = {o->fault}, .count = 1, .mean = o->mean, .score = o->score};
        memcpy(c.parts, o->parts, sizeof c.parts);
        rebuild(&c);
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
        // One more fault must explain more.
        if (best->fits || count == 0 || next[0].score > before - min_gain || next[0].score > max_score_for_a_third)
            break;
        memcpy(beam, next, sizeof beam);
        beam_count = count;
    }
    return true;
}

// --- the result

// Finds the faults that draw the same pictures in place of member `i` of a complete explanation.
static bool find_also(struct state *t, const struct candidate *best, int i, struct found_fault *found, lam_error *error)
{
    for (int m = 0; m < fault_count && found->also_count < MAX_ALSO; m++) {
        struct outcome *o = &t->outcomes[m];
        if (!o->applies || fault_is_style(&faults[m], t->s->interface) || faults[m].rare || faults[m].fit ||
            strcmp(faults[m].id, found->row->id) == 0 || (m > 0 && strcmp(faults[m].id, faults[m - 1].id) == 0))
            continue;
        double most = 2 * best->mean + same_mean;
        if (best->count == 1 && o->mean > most)
            continue;
        struct candidate c = *best;
        c.members[i] = o->fault;
        rebuild(&c);
        if (fault_set_equal(&c.set, &best->set))
            continue;
        if (!try_candidate(t, &c, most, error))
            return false;
        if (c.fits)
            found->also[found->also_count++] = &faults[m];
    }
    return true;
}

// Stores a candidate as the result, that which explains most first.
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
        rebuild(&part);
        if (!try_candidate(t, &part, no_limit, error))
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
    if (!best.fits && !t->s->has_unset_names) {
        struct candidate some;
        if (!try_supported(t, true, &some, error))
            return false;
        if (some.fits)
            best = some;
        else if (!try_sets(t, &best, error))
            return false;
        if (!best.fits && !try_supported(t, false, &best, error))
            return false;
    }
    return store(t, &best, error);
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
