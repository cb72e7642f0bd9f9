// fault_search.c: the search for the faults that explain the pictures.
//
// A beam search for the smallest set of faults whose pictures are the shader's: the scenes are drawn with each fault
// alone; where none explains every picture, with each of the best few and one more fault; and so on.
#include "fault_search.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { BEAM = 5 };

// As fractions of the initial difference: at most this much must remain after two faults for a search of three to be
// worthwhile, and after the search for a fault to be reported.
static const double max_ratio_for_a_third = 0.5, max_unexplained = 0.25;

static float clamped(float x) { return x > 0 ? (x < 1 ? x : 1) : 0; } // NaN: 0

// Blending uses alpha before anything clamps it, so values above 1 count.
static float bounded(float x) { return x > 0 ? (x < 4 ? x : 4) : 0; }

size_t fault_search_sample_count(const struct scene_comparison *scene)
{
    return scene->inside_count * (scene->alpha ? 4 : 3);
}

void fault_search_sample(const struct scene_comparison *scene, const float *picture, float *out)
{
    for (size_t i = 0; i < scene->inside_count; i++) {
        const float *p = picture + 4 * (size_t)scene->inside[i];
        for (int c = 0; c < 3; c++)
            *out++ = clamped(p[c]);
        if (scene->alpha)
            *out++ = bounded(p[3]);
    }
}

struct difference fault_search_difference(const struct scene_comparison *scene, const float *other, double tolerance)
{
    struct difference d = {.pixels = scene->inside_count};
    double sum = 0;
    uint64_t over = 0;
    size_t channels = scene->alpha ? 4 : 3;
    const float *theirs = scene->samples;
    for (size_t i = 0; i < scene->inside_count; i++, theirs += channels, other += channels) {
        double largest = 0;
        for (size_t c = 0; c < channels; c++) {
            double difference = (double)theirs[c] - (double)other[c];
            difference = difference < 0 ? -difference : difference;
            sum += difference;
            largest = difference > largest ? difference : largest;
        }
        over += largest > tolerance;
        d.maximum = largest > d.maximum ? largest : d.maximum;
    }
    if (d.pixels) {
        d.mean = sum / ((double)d.pixels * (double)channels);
        d.share_over = (double)over / (double)d.pixels;
    }
    d.fits = d.share_over <= 0.005 && d.mean <= tolerance / 4;
    return d;
}

// A set of faults, and the difference that it leaves.
struct candidate {
    const struct fault *rows[MAX_FOUND_FAULTS];
    double after[MAX_FOUND_FAULTS];
    int count;
    fault_set set;
    double mean;
    bool fits;
};

// The fault shader, with memory for one picture and its samples.
struct renderer {
    struct fault_shader *model; // opened for the first picture that is not in the cache
    float *pixels, *samples;
};

// The samples of a scene drawn with a set of faults; valid until the next call. NULL: see `error`.
static const float *render_faults(struct fault_search *s, struct renderer *renderer, int index, fault_set set,
                                  lam_error *error)
{
    const struct scene_comparison *scene = &s->scenes[index];
    struct render_key key = {.scene = (int)(scene->row - reference_scenes),
                             .contract = s->interface->which,
                             .light_frame = s->frame,
                             .reflection = s->reflection,
                             .vertex_lit = s->interface->vertex_lit,
                             .size = s->size,
                             .light_capacity = s->light_capacity,
                             .supports = s->interface->supports,
                             .set = set};
    const float *kept = render_cache_find(s->cache, &key);
    if (kept)
        return kept;
    if (!renderer->model && !(renderer->model = fault_shader_open(s->gl_device, s->size, error)))
        return NULL;
    if (!fault_shader_draw(renderer->model, &scene->reference_scene, s->interface, s->light_capacity, s->frame,
                           s->reflection, set, renderer->pixels, error))
        return NULL;
    float *out = render_cache_add(s->cache, &key, fault_search_sample_count(scene));
    out = out ? out : renderer->samples;
    fault_search_sample(scene, renderer->pixels, out);
    return out;
}

// Measures a candidate. Stops as soon as its mean exceeds `max_mean`. `each` (may be NULL) is filled for all scenes
// that do not pass, which come first.
static bool try_set(struct fault_search *s, struct candidate *t, double max_mean, struct renderer *renderer,
                    struct difference *each, lam_error *error)
{
    t->mean = 0;
    t->fits = true;
    for (int k = 0; k < s->scene_count; k++) {
        int i = s->order[k];
        if (t->mean > max_mean && (!each || s->scenes[i].passes))
            break;
        const float *fault_on = render_faults(s, renderer, i, t->set, error);
        if (!fault_on)
            return false;
        struct difference d = fault_search_difference(&s->scenes[i], fault_on, s->tolerance);
        if (each)
            each[i] = d;
        t->mean += d.mean / s->scene_count;
        t->fits = t->fits && d.fits;
    }
    t->after[t->count - 1] = t->mean;
    return true;
}

static bool is_better(const struct candidate *a, const struct candidate *b)
{
    return a->fits != b->fits ? a->fits : a->mean < b->mean - 1e-7; // equal candidates keep the table's order
}

// Inserts a candidate into the best BEAM, which are sorted.
static void beam_insert(struct candidate beam[BEAM], int *count, const struct candidate *t)
{
    for (int i = 0; i < *count; i++)
        if (beam[i].set == t->set)
            return;
    int at = *count;
    while (at > 0 && is_better(t, &beam[at - 1]))
        at--;
    if (at == BEAM)
        return;
    int last = *count < BEAM ? (*count)++ : BEAM - 1;
    for (int i = last; i > at; i--)
        beam[i] = beam[i - 1];
    beam[at] = *t;
}

// The scenes that a fault explains alone, as bits.
static uint32_t explained_by(const struct fault_search *s, const struct difference *each)
{
    uint32_t scenes = 0;
    for (int i = 0; i < s->scene_count; i++)
        if (!s->scenes[i].passes && each[i].fits)
            scenes |= (uint32_t)1 << i;
    return scenes;
}

static int count_bits(uint32_t bits)
{
    int count = 0;
    for (; bits; bits &= bits - 1)
        count++;
    return count;
}

static void assign_scene_faults(struct fault_search *s, const uint32_t *explained)
{
    int differ = 0, best = -1;
    for (int i = 0; i < s->scene_count; i++)
        differ += !s->scenes[i].passes;
    for (int m = 0; m < fault_count; m++)
        if (2 * count_bits(explained[m]) >= differ &&
            (best < 0 || count_bits(explained[m]) > count_bits(explained[best])))
            best = m;
    for (int i = 0; i < s->scene_count; i++) {
        s->scene_faults[i] = NULL;
        for (int k = 0; s->certain && k < s->count && !s->scene_faults[i]; k++)
            if (explained[s->found[k] - faults] >> i & 1)
                s->scene_faults[i] = s->found[k];
        if (!s->certain && best >= 0 && explained[best] >> i & 1)
            s->scene_faults[i] = &faults[best];
    }
}

// Orders the scenes: those that do not pass first, by descending difference.
static void order_scenes(struct fault_search *s)
{
    for (int i = 0; i < s->scene_count; i++) {
        int at = i;
        while (at > 0 && s->scenes[s->order[at - 1]].mean_difference < s->scenes[i].mean_difference) {
            s->order[at] = s->order[at - 1];
            at--;
        }
        s->order[at] = i;
    }
    int kept[MAX_SCENES], count = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < s->scene_count; k++)
            if (s->scenes[s->order[k]].passes == pass)
                kept[count++] = s->order[k];
    memcpy(s->order, kept, (size_t)count * sizeof *kept);
}

bool fault_search_run(struct fault_search *s, lam_error *error)
{
    order_scenes(s);
    size_t bytes = 4 * (size_t)s->size * (size_t)s->size * sizeof(float), scenes = (size_t)s->scene_count;
    struct renderer renderer = {.pixels = malloc(bytes), .samples = malloc(bytes)};
    struct difference *each = malloc(scenes * sizeof *each);
    uint32_t *explained = calloc((size_t)fault_count, sizeof *explained);
    bool ok = renderer.pixels && renderer.samples && each && explained;
    if (!ok)
        fail_memory(error, bytes);
    struct candidate beam[BEAM] = {{.mean = s->before}};
    int beam_count = 1;
    struct candidate best = {.mean = s->before}, first = best;
    for (int depth = 1; ok && depth <= (s->has_unset_names ? 1 : MAX_FOUND_FAULTS) && !best.fits; depth++) {
        struct candidate next[BEAM];
        int count = 0;
        for (int b = 0; ok && b < beam_count; b++)
            for (int m = 0; ok && m < fault_count; m++) {
                const struct fault *row = &faults[m];
                struct candidate t = beam[b];
                if ((t.set & row->set) == row->set ||
                    !fault_applies(row, s->interface, s->frame, s->reflection, s->needs))
                    continue;
                t.set |= row->set;
                t.rows[t.count++] = row;
                double max_mean = count == BEAM ? next[BEAM - 1].mean : 1e9;
                ok = try_set(s, &t, max_mean, &renderer, depth == 1 ? each : NULL, error);
                if (ok && depth == 1)
                    explained[m] = explained_by(s, each);
                if (ok && t.mean <= max_mean)
                    beam_insert(next, &count, &t);
            }
        // One more fault must explain more.
        if (count == 0 || (!next[0].fits && next[0].mean > 0.95 * best.mean))
            break;
        best = next[0];
        first = depth == 1 ? best : first;
        if (depth >= 2 && best.mean > max_ratio_for_a_third * s->before)
            break;
        memcpy(beam, next, sizeof beam);
        beam_count = count;
    }
    fault_shader_close(renderer.model);
    free(renderer.pixels);
    free(renderer.samples);
    free(each);
    s->certain = best.fits;
    // Without a complete explanation, the best single fault is reported if it leaves less than a quarter unexplained.
    if (!best.fits)
        best = first;
    s->count = best.fits || (!s->has_unset_names && best.mean < max_unexplained * s->before) ? best.count : 0;
    for (int i = 0; i < s->count; i++) {
        s->found[i] = best.rows[i];
        s->after[i] = best.after[i];
    }
    if (ok)
        assign_scene_faults(s, explained);
    free(explained);
    return ok;
}
