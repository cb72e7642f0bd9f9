// fault_search.c: which mistakes explain the pictures.
//
// The model draws the scenes with one mistake after the other; where none explains every picture, with those
// of the nearest few and one more, and so on: a beam search for the smallest set of mistakes whose pictures
// are the ones that the shader gave.
#include "fault_search.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { BEAM = 5 };

// What two mistakes leave of the difference for a search of three to be worth its time, and what may be left
// unexplained at the end.
static const double worth_a_third = 0.5, unexplained_most = 0.25;

static float clamped(float x) { return x > 0 ? (x < 1 ? x : 1) : 0; } // NaN: 0

// Alpha is blended with before anything clamps it, so what is above 1 counts.
static float bounded(float x) { return x > 0 ? (x < 4 ? x : 4) : 0; }

size_t fault_search_gathered_count(const struct judged *scene) { return scene->inside_count * (scene->alpha ? 4 : 3); }

void fault_search_gather(const struct judged *scene, const float *picture, float *out)
{
    for (size_t i = 0; i < scene->inside_count; i++) {
        const float *p = picture + 4 * (size_t)scene->inside[i];
        for (int c = 0; c < 3; c++)
            *out++ = clamped(p[c]);
        if (scene->alpha)
            *out++ = bounded(p[3]);
    }
}

struct distance fault_search_distance(const struct judged *scene, const float *other, double tolerance)
{
    struct distance d = {.pixels = scene->inside_count};
    double sum = 0;
    uint64_t over = 0;
    size_t channels = scene->alpha ? 4 : 3;
    const float *theirs = scene->gathered;
    for (size_t i = 0; i < scene->inside_count; i++, theirs += channels, other += channels) {
        double most = 0;
        for (size_t c = 0; c < channels; c++) {
            double apart = (double)theirs[c] - (double)other[c];
            apart = apart < 0 ? -apart : apart;
            sum += apart;
            most = apart > most ? apart : most;
        }
        over += most > tolerance;
        d.maximum = most > d.maximum ? most : d.maximum;
    }
    if (d.pixels) {
        d.mean = sum / ((double)d.pixels * (double)channels);
        d.share_over = (double)over / (double)d.pixels;
    }
    d.fits = d.share_over <= 0.005 && d.mean <= tolerance / 4;
    return d;
}

// A set of mistakes that has been tried.
struct tried {
    const struct fault *rows[FOUND_MOST];
    double after[FOUND_MOST];
    int count;
    fault_set set;
    double mean;
    bool fits;
};

// What draws, and room for a picture and its gathered numbers.
struct desk {
    struct fault_shader *model; // opened when a picture is first needed that is not kept
    float *pixels, *gathered;
};

// The gathered numbers of a scene drawn with a set of mistakes; valid until the next call. NULL: `error`.
static const float *picture_of(struct search *s, struct desk *desk, int index, fault_set set, lam_error *error)
{
    const struct judged *scene = &s->scenes[index];
    struct picture_key key = {.scene = (int)(scene->row - reference_scenes),
                              .contract = s->reading->which,
                              .light_frame = s->frame,
                              .reflection = s->reflection,
                              .vertex_lit = s->reading->vertex_lit,
                              .size = s->size,
                              .room = s->room,
                              .offers = s->reading->offers,
                              .set = set};
    const float *kept = render_cache_find(s->pictures, &key);
    if (kept)
        return kept;
    if (!desk->model && !(desk->model = fault_shader_open(s->gl_device, s->size, error)))
        return NULL;
    if (!fault_shader_draw(desk->model, &scene->reference_scene, s->reading, s->room, s->frame, s->reflection, set,
                           desk->pixels, error))
        return NULL;
    float *out = render_cache_add(s->pictures, &key, fault_search_gathered_count(scene));
    out = out ? out : desk->gathered;
    fault_search_gather(scene, desk->pixels, out);
    return out;
}

// Stops where the mean is above `most` already: then it is of no use. `each` (may be NULL) is filled for all
// scenes that do not pass; those stand first.
static bool try_set(struct search *s, struct tried *t, double most, struct desk *desk, struct distance *each,
                    lam_error *error)
{
    t->mean = 0;
    t->fits = true;
    for (int k = 0; k < s->scene_count; k++) {
        int i = s->order[k];
        if (t->mean > most && (!each || s->scenes[i].passes))
            break;
        const float *mistaken = picture_of(s, desk, i, t->set, error);
        if (!mistaken)
            return false;
        struct distance d = fault_search_distance(&s->scenes[i], mistaken, s->tolerance);
        if (each)
            each[i] = d;
        t->mean += d.mean / s->scene_count;
        t->fits = t->fits && d.fits;
    }
    t->after[t->count - 1] = t->mean;
    return true;
}

static bool nearer(const struct tried *a, const struct tried *b)
{
    return a->fits != b->fits ? a->fits : a->mean < b->mean - 1e-7; // equal ones keep the table's order
}

// Keeps the nearest BEAM, nearest first.
static void keep(struct tried beam[BEAM], int *count, const struct tried *t)
{
    for (int i = 0; i < *count; i++)
        if (beam[i].set == t->set)
            return;
    int at = *count;
    while (at > 0 && nearer(t, &beam[at - 1]))
        at--;
    if (at == BEAM)
        return;
    int last = *count < BEAM ? (*count)++ : BEAM - 1;
    for (int i = last; i > at; i--)
        beam[i] = beam[i - 1];
    beam[at] = *t;
}

// The scenes that a mistake explains by itself, as bits.
static uint32_t explained_by(const struct search *s, const struct distance *each)
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

static void tell_alone(struct search *s, const uint32_t *explained)
{
    int differ = 0, best = -1;
    for (int i = 0; i < s->scene_count; i++)
        differ += !s->scenes[i].passes;
    for (int m = 0; m < fault_count; m++)
        if (2 * count_bits(explained[m]) >= differ &&
            (best < 0 || count_bits(explained[m]) > count_bits(explained[best])))
            best = m;
    for (int i = 0; i < s->scene_count; i++) {
        s->alone[i] = NULL;
        for (int k = 0; s->certain && k < s->count && !s->alone[i]; k++)
            if (explained[s->found[k] - mistakes] >> i & 1)
                s->alone[i] = s->found[k];
        if (!s->certain && best >= 0 && explained[best] >> i & 1)
            s->alone[i] = &mistakes[best];
    }
}

// Scenes that do not pass first, the farthest off before the others.
static void put_in_order(struct search *s)
{
    for (int i = 0; i < s->scene_count; i++) {
        int at = i;
        while (at > 0 && s->scenes[s->order[at - 1]].apart < s->scenes[i].apart) {
            s->order[at] = s->order[at - 1];
            at--;
        }
        s->order[at] = i;
    }
    int kept[ORDER_MOST], count = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < s->scene_count; k++)
            if (s->scenes[s->order[k]].passes == pass)
                kept[count++] = s->order[k];
    memcpy(s->order, kept, (size_t)count * sizeof *kept);
}

bool fault_search_run(struct search *s, lam_error *error)
{
    put_in_order(s);
    size_t bytes = 4 * (size_t)s->size * (size_t)s->size * sizeof(float), scenes = (size_t)s->scene_count;
    struct desk desk = {.pixels = malloc(bytes), .gathered = malloc(bytes)};
    struct distance *each = malloc(scenes * sizeof *each);
    uint32_t *explained = calloc((size_t)fault_count, sizeof *explained);
    bool ok = desk.pixels && desk.gathered && each && explained;
    if (!ok)
        fail_memory(error, bytes);
    struct tried beam[BEAM] = {{.mean = s->before}};
    int held = 1;
    struct tried best = {.mean = s->before}, first = best;
    for (int depth = 1; ok && depth <= (s->unset ? 1 : FOUND_MOST) && !best.fits; depth++) {
        struct tried next[BEAM];
        int count = 0;
        for (int b = 0; ok && b < held; b++)
            for (int m = 0; ok && m < fault_count; m++) {
                const struct fault *row = &mistakes[m];
                struct tried t = beam[b];
                if ((t.set & row->set) == row->set ||
                    !fault_applies(row, s->reading, s->frame, s->reflection, s->needs))
                    continue;
                t.set |= row->set;
                t.rows[t.count++] = row;
                double most = count == BEAM ? next[BEAM - 1].mean : 1e9;
                ok = try_set(s, &t, most, &desk, depth == 1 ? each : NULL, error);
                if (ok && depth == 1)
                    explained[m] = explained_by(s, each);
                if (ok && t.mean <= most)
                    keep(next, &count, &t);
            }
        // One mistake more must explain more.
        if (count == 0 || (!next[0].fits && next[0].mean > 0.95 * best.mean))
            break;
        best = next[0];
        first = depth == 1 ? best : first;
        if (depth >= 2 && best.mean > worth_a_third * s->before)
            break;
        memcpy(beam, next, sizeof beam);
        held = count;
    }
    fault_shader_close(desk.model);
    free(desk.pixels);
    free(desk.gathered);
    free(each);
    s->certain = best.fits;
    // Short of an explanation, the one mistake that leaves less than a quarter unexplained is told.
    if (!best.fits)
        best = first;
    s->count = best.fits || (!s->unset && best.mean < unexplained_most * s->before) ? best.count : 0;
    for (int i = 0; i < s->count; i++) {
        s->found[i] = best.rows[i];
        s->after[i] = best.after[i];
    }
    if (ok)
        tell_alone(s, explained);
    free(explained);
    return ok;
}
