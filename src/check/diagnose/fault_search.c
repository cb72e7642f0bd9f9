// fault_search.c: the search for the faults that explain the pictures.
//
// 1. Each fault alone. 2. Together, those that explain scenes of their own. 3. A beam search: each of the best few with
// one more fault, and so on. 4. If no set explains every picture: the faults that explain some, and spoil none.
#include "fault_search.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "shader_constants.h"
#include "linear.h"

enum { BEAM = 6 };

// As fractions of the difference without faults: at most this much must remain after two faults for a search of three to
// be worthwhile; and after the faults that explain a scene or all of them. What remains of an exact explanation, over
// all scenes, comes from rounding.
static const double max_ratio_for_a_third = 0.5, max_ratio_explained = 0.125, max_exact = 2e-4;

// A set of faults, and the difference that it leaves.
struct candidate {
    struct found_fault members[MAX_FOUND_FAULTS];
    int count;
    fault_set set;
    double mean; // over all scenes
    bool fits;
};

// What a fault does alone.
struct outcome {
    struct found_fault fault;
    double mean;
    uint32_t explained; // the scenes that differ and that it explains
    bool applies, spoils_known, spoils;
};

struct state {
    struct fault_search *s;
    struct scene_comparison *scenes; // of s, reduced to the pixels that are drawn
    int stride, size;                // of the fault shader's pictures
    struct fault_shader *shader;     // opened when it is first needed
    float *pixels, *samples;         // of one picture
    int order[MAX_SCENES];           // those that differ first, by descending difference
    int differ_count;
    struct outcome *outcomes; // of each row of the table
};

// --- drawing and measuring

static bool draw(struct state *t, int index, const fault_set *set, float *pixels, lam_error *error)
{
    struct fault_search *s = t->s;
    if (!t->shader && !(t->shader = fault_shader_open(s->gl_device, s->size, t->stride, error)))
        return false;
    return fault_shader_draw(t->shader, &t->scenes[index].reference_scene, s->interface, s->light_capacity, s->frame,
                             s->reflection, set, pixels, error);
}

// The samples of a scene drawn with faults. NULL: see `error`.
static const float *render_faults(struct state *t, int index, const fault_set *set, lam_error *error)
{
    struct fault_search *s = t->s;
    const struct scene_comparison *scene = &t->scenes[index];
    struct render_key key = {.scene = (int)(scene->row - reference_scenes),
                             .contract = s->interface->contract->hash,
                             .declared = s->interface->declared,
                             .numbers = shader_constants_hash(s->interface),
                             .light_frame = s->frame,
                             .reflection = s->reflection,
                             .vertex_lit = s->interface->vertex_lit,
                             .size = s->size,
                             .light_capacity = s->light_capacity,
                             .supports = s->interface->supports,
                             .expectation = s->expectation,
                             .set = *set};
    const float *kept = render_cache_find(s->cache, &key);
    if (kept)
        return kept;
    if (!draw(t, index, set, t->pixels, error))
        return NULL;
    float *out = render_cache_add(s->cache, &key, scene_comparison_sample_count(scene));
    out = out ? out : t->samples;
    scene_comparison_sample(scene, t->pixels, out);
    return out;
}

static bool measure(struct state *t, int index, const fault_set *set, struct difference *d, lam_error *error)
{
    const float *samples = render_faults(t, index, set, error);
    if (samples)
        *d = scene_comparison_difference(&t->scenes[index], samples, t->s->tolerance);
    return samples != NULL;
}

// Measures a candidate in all scenes. Stops as soon as its mean exceeds `max_mean`.
static bool try_candidate(struct state *t, struct candidate *c, double max_mean, lam_error *error)
{
    c->mean = 0;
    c->fits = true;
    for (int k = 0; k < t->s->scene_count; k++) {
        struct difference d;
        if (!measure(t, t->order[k], &c->set, &d, error))
            return false;
        c->mean += d.mean / t->s->scene_count;
        c->fits = c->fits && d.fits;
        if (c->mean > max_mean) {
            c->fits = false;
            break;
        }
    }
    return true;
}

static fault_set with_fault(const fault_set *set, const struct found_fault *fault)
{
    fault_set out = fault_set_add(set, fault->row);
    if (fault->row->fit == FIT_CONSTANT)
        out.constant = fault->exponent;
    else if (fault->row->fit)
        out.factor = fault->exponent;
    return out;
}

static void rebuild(struct candidate *c)
{
    c->set = (fault_set){0};
    for (int i = 0; i < c->count; i++)
        c->set = with_fault(&c->set, &c->members[i]);
}

// --- fitting an exponent

// The difference in a scene where the exponent is multiplied, or replaced, by 2^x.
static bool try_exponent(struct state *t, int scene, const fault_set *base, const struct fault *row, double exponent,
                         double *mean, lam_error *error)
{
    struct found_fault fault = {.row = row, .exponent = (float)exponent};
    fault_set set = with_fault(base, &fault);
    struct difference d;
    bool ok = measure(t, scene, &set, &d, error);
    *mean = ok ? d.mean : 0;
    return ok;
}

static bool is_near(double a, double b) { return a > 0.98 * b && a < 1.02 * b; }

// The number that somebody would have written: 2 for 1.99, 0.5 for 0.502, 0.3 for 0.299.
static double plain_number(double x)
{
    double whole = x >= 1 ? (double)(long)(x + 0.5) : 1 / (double)(long)(1 / x + 0.5);
    double tenth = (double)(long)(x * 10 + 0.5) / 10;
    return is_near(whole, x) ? whole : is_near(tenth, x) ? tenth : x;
}

// Finds the factor of the exponent, or the constant, by the scene with a highlight that differs most. 0: none.
static bool fit_exponent(struct state *t, const fault_set *base, const struct fault *row, float *exponent,
                         lam_error *error)
{
    enum { STEPS = 18, TURNS = 9 };
    static const double golden = 0.6180339887;
    int scene = -1;
    for (int k = 0; k < t->differ_count && scene < 0; k++)
        if (t->scenes[t->order[k]].reference_scene.ks > 0)
            scene = t->order[k];
    *exponent = 0;
    if (scene < 0)
        return true;
    double from = row->fit == FIT_SMALLER  ? -7.5
                  : row->fit == FIT_LARGER ? 0.1
                                           : 0,
           to = row->fit == FIT_SMALLER  ? -0.1
                : row->fit == FIT_LARGER ? 7.5
                                         : 9,
           best = 1e9, at = from;
    double step = (to - from) / STEPS, mean = 0;
    for (int i = 0; i <= STEPS; i++) {
        if (!try_exponent(t, scene, base, row, math_exp2(from + i * step), &mean, error))
            return false;
        if (mean < best) {
            best = mean;
            at = from + i * step;
        }
    }
    double low = at - step, high = at + step;
    for (int i = 0; i < TURNS; i++) {
        double a = high - golden * (high - low), b = low + golden * (high - low), mean_a, mean_b;
        if (!try_exponent(t, scene, base, row, math_exp2(a), &mean_a, error) ||
            !try_exponent(t, scene, base, row, math_exp2(b), &mean_b, error))
            return false;
        *(mean_a < mean_b ? &high : &low) = mean_a < mean_b ? b : a;
    }
    double fitted = math_exp2((low + high) / 2), plain = plain_number(fitted), mean_plain;
    if (!try_exponent(t, scene, base, row, fitted, &mean, error) ||
        !try_exponent(t, scene, base, row, plain, &mean_plain, error))
        return false;
    *exponent = (float)(mean_plain <= mean * 1.05 + 1e-5 ? plain : fitted);
    return true;
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
    bool ok = fit_exponent(t, base, row, &out->exponent, error);
    *possible = out->exponent > 0;
    return ok;
}

// --- one fault

static bool explains(const struct scene_comparison *scene, const struct difference *d)
{
    return d->fits && d->mean <= max_ratio_explained * scene->mean_difference;
}

// Tries each fault of the table alone in the scenes that differ. `best` is the best that explains everything.
static bool try_each(struct state *t, struct candidate *best, lam_error *error)
{
    struct fault_search *s = t->s;
    const fault_set none = {0};
    for (int m = 0; m < fault_count; m++) {
        struct outcome *o = &t->outcomes[m];
        o->applies = fault_applies(&faults[m], s->interface, s->frame, s->reflection, s->needs);
        if (o->applies && !prepare_member(t, &none, &faults[m], &o->fault, &o->applies, error))
            return false;
        if (!o->applies)
            continue;
        struct candidate c = {.members = {o->fault}, .count = 1, .set = with_fault(&none, &o->fault)};
        bool fits = true;
        for (int k = 0; k < t->differ_count; k++) {
            struct difference d;
            int i = t->order[k];
            if (!measure(t, i, &c.set, &d, error))
                return false;
            o->mean += d.mean / s->scene_count;
            fits = fits && d.fits;
            if (explains(&t->scenes[i], &d))
                o->explained |= (uint32_t)1 << i;
        }
        if (!fits)
            continue;
        if (!try_candidate(t, &c, 1e9, error))
            return false;
        // Of equal faults the first in the table is found.
        if (c.fits && c.mean <= max_ratio_explained * s->before && (!best->fits || c.mean < best->mean - 1e-7))
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
    fault_set set = with_fault(&none, &fault);
    for (int k = t->differ_count; k < t->s->scene_count && !o->spoils; k++) {
        struct difference d;
        if (!measure(t, t->order[k], &set, &d, error))
            return false;
        o->spoils = !d.fits;
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
        if (!try_candidate(t, &less, 1e9, error))
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
        supported = supported && (c->members[i].row->style || outcome_of(t, c->members[i].row)->explained);
    c->fits = c->fits && supported;
    return true;
}

// Together, the faults that explain scenes of their own, those that explain most first. `all`: those must explain every
// picture; otherwise, as many as explain further scenes and contradict none.
static bool try_supported(struct state *t, bool all, struct candidate *c, lam_error *error)
{
    struct fault_search *s = t->s;
    uint32_t covered = 0;
    bool *used = calloc((size_t)fault_count, sizeof *used);
    bool ok = used || fail_memory(error, (size_t)fault_count);
    *c = (struct candidate){.mean = s->before};
    while (ok && c->count < MAX_FOUND_FAULTS) {
        struct outcome *next = NULL;
        for (int m = 0; ok && m < fault_count; m++) {
            struct outcome *o = &t->outcomes[m];
            int mine = count_bits(o->explained & ~covered), most = next ? count_bits(next->explained & ~covered) : 0;
            if (used[m] || !mine || faults[m].style || mine < most || (mine == most && o->mean >= next->mean))
                continue;
            ok = find_spoils(t, o, error);
            if (ok && !o->spoils)
                next = o;
        }
        if (!ok || !next)
            break;
        used[next - t->outcomes] = true;
        struct candidate more = *c;
        more.members[more.count++] = next->fault;
        rebuild(&more);
        ok = try_candidate(t, &more, 1e9, error);
        if (all || (ok && more.mean < c->mean)) {
            *c = more;
            covered |= next->explained;
        }
    }
    free(used);
    return ok && (!all || !c->fits || reduce(t, c, error));
}

static bool is_better(const struct candidate *a, const struct candidate *b)
{
    return a->fits != b->fits ? a->fits : a->mean < b->mean - 1e-7; // equal candidates keep the table's order
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
        for (int m = 0; m < fault_count; m++) {
            struct outcome *o = &t->outcomes[m];
            struct candidate c = beam[b];
            fault_set same = fault_set_add(&c.set, &faults[m]);
            if (!o->applies || (!faults[m].fit && fault_set_equal(&same, &c.set)))
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
            double max_mean = *count == BEAM ? next[BEAM - 1].mean : 1e9;
            if (!try_candidate(t, &c, max_mean, error))
                return false;
            if (c.mean <= max_mean)
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
        struct candidate c = {.members = {o->fault}, .count = 1, .mean = o->mean};
        rebuild(&c);
        beam_insert(beam, &beam_count, &c);
    }
    for (int depth = 2; depth <= MAX_FOUND_FAULTS && beam_count > 0; depth++) {
        struct candidate next[BEAM];
        int count = 0;
        double before = beam[0].mean;
        if (!extend(t, beam, beam_count, next, &count, error))
            return false;
        for (int i = 0; i < count && next[i].fits && !best->fits; i++) {
            if (!reduce(t, &next[i], error))
                return false;
            if (next[i].fits)
                *best = next[i];
        }
        // One more fault must explain more.
        if (best->fits || count == 0 || next[0].mean > 0.95 * before ||
            next[0].mean > max_ratio_for_a_third * t->s->before)
            break;
        memcpy(beam, next, sizeof beam);
        beam_count = count;
    }
    return true;
}

// --- the result

// Orders the scenes: those that differ first, by descending difference.
static void order_scenes(struct state *t)
{
    const struct scene_comparison *scenes = t->scenes;
    for (int i = 0; i < t->s->scene_count; i++) {
        int at = i;
        while (at > 0 && (scenes[t->order[at - 1]].passes > scenes[i].passes ||
                          (scenes[t->order[at - 1]].passes == scenes[i].passes &&
                           scenes[t->order[at - 1]].mean_difference < scenes[i].mean_difference))) {
            t->order[at] = t->order[at - 1];
            at--;
        }
        t->order[at] = i;
        t->differ_count += !scenes[i].passes;
    }
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
        if (!try_candidate(t, &part, 1e9, error))
            return false;
        if (c->members[i].row->style) {
            s->style = c->members[i].row;
            continue;
        }
        s->found[s->count] = c->members[i];
        s->found[s->count++].after = part.mean;
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

// Copies a scene with those of its compared pixels that the fault shader draws. `memory`: 5 floats for each pixel of
// its pictures.
static void reduce_scene(const struct state *t, const struct scene_comparison *from, struct scene_comparison *to,
                         float *memory)
{
    int size = t->s->size, stride = t->stride;
    size_t pixels = (size_t)t->size * (size_t)t->size;
    *to = *from;
    to->inside = (uint32_t *)(memory + 4 * pixels);
    to->samples = memory;
    to->inside_count = 0;
    for (size_t i = 0; i < from->inside_count; i++) {
        int x = (int)from->inside[i] % size, from_below = size - 1 - (int)from->inside[i] / size;
        if (x % stride || from_below % stride)
            continue;
        int index = (t->size - 1 - from_below / stride) * t->size + x / stride;
        size_t channels = from->alpha ? 4 : 3;
        memcpy(to->samples + channels * to->inside_count, from->samples + channels * i, channels * sizeof(float));
        to->inside[to->inside_count++] = (uint32_t)index;
    }
}

bool fault_search_run(struct fault_search *s, lam_error *error)
{
    // In large pictures, every second pixel of every second row tells as much.
    struct state t = {.s = s, .stride = s->size >= 96 ? 2 : 1};
    t.size = fault_shader_size(s->size, t.stride);
    size_t pixels = (size_t)t.size * (size_t)t.size, count = (size_t)s->scene_count;
    t.pixels = malloc(4 * pixels * sizeof *t.pixels);
    t.samples = malloc(4 * pixels * sizeof *t.samples);
    t.outcomes = calloc((size_t)fault_count, sizeof *t.outcomes);
    t.scenes = calloc(count, sizeof *t.scenes);
    float *memory = malloc(count * 5 * pixels * sizeof *memory + 1);
    bool ok = (t.pixels && t.samples && t.outcomes && t.scenes && memory) || fail_memory(error, count * 20 * pixels);
    for (size_t i = 0; ok && i < count; i++)
        reduce_scene(&t, &s->scenes[i], &t.scenes[i], memory + i * 5 * pixels);
    if (ok)
        order_scenes(&t);
    ok = ok && search(&t, error);
    fault_shader_close(t.shader);
    free(t.pixels);
    free(t.samples);
    free(t.outcomes);
    free(t.scenes);
    free(memory);
    return ok;
}

bool fault_search_draw_style(struct fault_search *s, int scene, float *pixels, lam_error *error)
{
    struct state t = {.s = s, .scenes = s->scenes, .stride = 1, .size = s->size};
    const fault_set none = {0};
    fault_set set = fault_set_add(&none, s->style);
    bool ok = draw(&t, scene, &set, pixels, error);
    fault_shader_close(t.shader);
    return ok;
}
