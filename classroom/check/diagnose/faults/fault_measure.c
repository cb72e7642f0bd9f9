// fault_measure.c: compares the shader's pictures with pictures that contain faults, cached or drawn.
#include "fault_candidate.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "linear.h"
#include "shader_interface.h"

// Copies a scene, reduced to the compared pixels that the fault shader draws. `memory` provides 5 floats for each pixel
// of the fault shader's pictures.
static void reduce_scene(const struct fault_measure *t, const struct scene_comparison *from,
                         struct scene_comparison *to, float *memory)
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

// Orders scenes: differing scenes first, by descending difference.
static void order_scenes(struct fault_measure *t)
{
    const struct scene_comparison *scenes = t->scenes;
    for (int i = 0; i < t->s->scene_count; i++) {
        if (scenes[i].spoilt)
            continue;
        int at = t->scene_count++;
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

bool fault_measure_open(struct fault_measure *t, struct fault_search *s, lam_error *error)
{
    // In large pictures, every second or third pixel of every second or third row is enough (35² to 48² pixels). If a
    // GPU may round corners to 1/16 of a pixel, all pixels are measured, because this error would be larger in a
    // picture with fewer pixels.
    int stride = s->size >= 96 ? (s->size + 20) / 43 : s->size >= 70 ? 2 : 1;
    *t = (struct fault_measure){.s = s, .stride = s->painter->es_only ? 1 : stride};
    t->size = fault_shader_size(s->size, t->stride);
    size_t pixels = (size_t)t->size * (size_t)t->size, count = (size_t)s->scene_count;
    t->pixels = malloc(4 * pixels * sizeof *t->pixels);
    t->samples = malloc(4 * pixels * sizeof *t->samples);
    t->scenes = calloc(count, sizeof *t->scenes);
    t->memory = malloc(count * 5 * pixels * sizeof *t->memory + 1);
    if (!t->pixels || !t->samples || !t->scenes || !t->memory) {
        fault_measure_close(t);
        return fail_memory(error, count * 20 * pixels);
    }
    for (size_t i = 0; i < count; i++)
        reduce_scene(t, &s->scenes[i], &t->scenes[i], t->memory + i * 5 * pixels);
    order_scenes(t);
    return true;
}

void fault_measure_close(struct fault_measure *t)
{
    render_cache_keep_shader(t->s->cache, t->shader);
    free(t->pixels);
    free(t->samples);
    free(t->scenes);
    free(t->memory);
    *t = (struct fault_measure){0};
}

bool fault_measure_draw(struct fault_measure *t, int index, const fault_set *set, float *pixels, lam_error *error)
{
    struct fault_search *s = t->s;
    if (!t->shader && !(t->shader = render_cache_take_shader(s->cache, s->painter, s->size, t->stride, error)))
        return false;
    struct fault_model model = {s->interface, s->frame, s->reflection};
    if (!fault_shader_draw(t->shader, &t->scenes[index].reference_scene, &model, set, pixels, error))
        return false;
    scene_comparison_apply_tone(s->interface->printed_tone, pixels, (size_t)t->size * (size_t)t->size);
    return true;
}

// Returns the samples of a scene drawn with faults. On failure, fills `error` and returns NULL.
static const float *render_faults(struct fault_measure *t, int index, const fault_set *set, lam_error *error)
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
                             .factors = s->interface->factors,
                             .tone = s->interface->printed_tone,
                             .expectation = s->expectation,
                             .set = *set};
    const float *kept = render_cache_find(s->cache, &key);
    if (kept)
        return kept;
    if (!fault_measure_draw(t, index, set, t->pixels, error))
        return NULL;
    scene_comparison_sample(scene, t->pixels, t->samples);
    render_cache_add(s->cache, &key, t->samples, scene_comparison_sample_count(scene));
    return t->samples;
}

bool fault_measure_scene(struct fault_measure *t, int index, const fault_set *set, struct difference *d,
                         lam_error *error)
{
    const float *samples = render_faults(t, index, set, error);
    t->pictures++;
    if (samples)
        *d = scene_comparison_difference(&t->scenes[index], samples, t->s->tolerance);
    return samples != NULL;
}

fault_set fault_measure_with(const fault_set *set, const struct found_fault *fault)
{
    fault_set out = fault_set_add(set, fault->row);
    if (fault->row->fit == FIT_CONSTANT)
        out.constant = fault->exponent;
    else if (fault->row->fit)
        out.factor = fault->exponent;
    return out;
}

// --- fitting an exponent

// Gets the difference in a scene if the exponent is multiplied by 2^x, or replaced by 2^x.
static bool try_exponent(struct fault_measure *t, int scene, const fault_set *base, const struct fault *row,
                         double exponent, double *mean, lam_error *error)
{
    struct found_fault fault = {.row = row, .exponent = (float)exponent};
    fault_set set = fault_measure_with(base, &fault);
    struct difference d;
    bool ok = fault_measure_scene(t, scene, &set, &d, error);
    *mean = ok ? d.mean : 0;
    return ok;
}

static bool is_near(double a, double b) { return a > 0.98 * b && a < 1.02 * b; }

// Returns the nearest number that a person would write: 2 for 1.99, 0.5 for 0.502, 0.3 for 0.299.
static double plain_number(double x)
{
    double whole = x >= 1 ? (double)(long)(x + 0.5) : 1 / (double)(long)(1 / x + 0.5);
    double tenth = (double)(long)(x * 10 + 0.5) / 10;
    return is_near(whole, x) ? whole : is_near(tenth, x) ? tenth : x;
}

// Gets the range of x that the fit tries: the highlight's exponent is multiplied by 2^x, or replaced by 2^x.
static void range_of(const struct fault *row, double *from, double *to)
{
    static const double ranges[][2] = {
        [FIT_LARGER] = {0.1, 7.5}, [FIT_SMALLER] = {-7.5, -0.1}, [FIT_CONSTANT] = {0, 9}};
    *from = ranges[row->fit][0];
    *to = ranges[row->fit][1];
}

// Finds the differing scene that depends most on the exponent, or −1 if there is none.
static bool find_sensitive(struct fault_measure *t, const fault_set *base, const struct fault *row, int *scene,
                           lam_error *error)
{
    double from, to, most = 1e-4;
    range_of(row, &from, &to);
    *scene = -1;
    for (int k = 0, tried = 0; k < t->differ_count && tried < 4; k++) { // only the four scenes with the largest
                                                                        // differences
        int i = t->order[k];
        double low = 1e9, high = 0;
        if (t->scenes[i].reference_scene.ks <= 0)
            continue;
        tried++;
        for (int turn = 1; turn <= 3; turn++) {
            double mean;
            if (!try_exponent(t, i, base, row, math_exp2(from + turn * (to - from) / 4), &mean, error))
                return false;
            low = mean < low ? mean : low;
            high = mean > high ? mean : high;
        }
        if (high - low > most) {
            most = high - low;
            *scene = i;
        }
    }
    return true;
}

bool fault_measure_fit(struct fault_measure *t, const fault_set *base, const struct fault *row, float *exponent,
                       lam_error *error)
{
    enum { STEPS = 18, TURNS = 9 };
    static const double golden = 0.6180339887;
    int scene;
    double from, to, best = 1e9, at = 0;
    *exponent = 0;
    range_of(row, &from, &to);
    if (!find_sensitive(t, base, row, &scene, error))
        return false;
    if (scene < 0)
        return true;
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
