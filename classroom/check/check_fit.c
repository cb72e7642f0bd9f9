// check_fit.c: compares a shader that has its own strengths and colours with sums of an ambient, a diffuse and a
// specular term.
//
// The fault shader draws each term of a scene in a separate channel (shader_interface_scene). An interpretation
// consists of a highlight, an exponent, and either accepted forms or a fault. The factors of the terms are the same in
// every scene, and the check finds them by least squares. The shader passes if an interpretation without a mistake
// explains every scene. The shader differs if an interpretation with a single known mistake explains every scene.
// Otherwise there is no verdict, because a shader that the check does not understand may be correct.
#include "interpretations.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arena.h"
#include "elementary.h"
#include "fail.h"
#include "fault_search.h"
#include "render_cache.h"

enum { FIRST_SCENES = 1, MAX_BASES = 12, MAX_NEAREST = 3 };

static const double min_diffuse = 0.02;  // a smaller factor of a diffuse term is no evidence of lighting
static const double min_mean = 0.02;     // smaller mean differences need no explanation
static const double max_negative = 0.01; // a factor below −max_negative cannot be a strength

struct fit {
    struct run *r;
    struct fault_shader *shader; // draws every `stride`-th pixel of every `stride`-th row
    int stride, size;
    uint32_t *from[MAX_SCENES],
        *to[MAX_SCENES]; // pixel indices in the shader's pictures and in the pictures of the fault shader
    size_t count[MAX_SCENES];
    float *basis[MAX_SCENES], *pixels;
};

// --- pictures

static bool draw_terms(struct run *r, struct fault_shader *shader, int scene, const struct interpretation *g,
                       float *pixels, lam_error *error)
{
    struct fault_model model = {&r->interface, r->interface.light_frame, g->reflection};
    return fault_shader_draw(shader, &r->scenes[scene].reference_scene, &model, &g->set, pixels, error);
}

static double decode(double x, bool decoded) { return decoded && x > 0 ? math_pow(x, 2.2) : x; }

// Finds the factors by least squares over the first `scene_count` scenes.
static void solve(const struct fit *f, int scene_count, struct interpretation *g)
{
    for (int c = 0; c < 3; c++) {
        double a[3][4] = {{0}};
        for (int s = 0; s < scene_count; s++)
            for (size_t i = 0; i < f->count[s]; i++) {
                double y = (double)f->r->scenes[s].theirs[4 * (size_t)f->from[s][i] + (size_t)c];
                if (!(y > 0 && y < 1)) // clamped, or not a number
                    continue;
                const float *b = f->basis[s] + 3 * i;
                y = decode(y, g->decoded);
                for (int k = 0; k < 3; k++) {
                    for (int m = 0; m < 3; m++)
                        a[k][m] += (double)b[k] * (double)b[m];
                    a[k][3] += (double)b[k] * y;
                }
            }
        for (int k = 0; k < 3; k++) { // Gaussian elimination; terms that are zero everywhere are skipped
            if (a[k][k] < 1e-6 || (k == 2 && !g->has_highlight))
                continue;
            for (int m = 0; m < 3; m++) {
                double times = m == k ? 0 : a[m][k] / a[k][k];
                for (int n = 0; n < 4; n++)
                    a[m][n] -= times * a[k][n];
            }
        }
        for (int k = 0; k < 3; k++)
            g->factors[c][k] = a[k][k] < 1e-6 || (k == 2 && !g->has_highlight) ? 0 : a[k][3] / a[k][k];
    }
}

static double clamped(double x) { return x > 0 ? (x < 1 ? x : 1) : 0; }

// Measures an interpretation in the first `scene_count` scenes.
static bool measure(struct fit *f, int scene_count, struct interpretation *g, lam_error *error)
{
    for (int s = 0; s < scene_count; s++) {
        if (!draw_terms(f->r, f->shader, s, g, f->pixels, error))
            return false;
        for (size_t i = 0; i < f->count[s]; i++)
            memcpy(f->basis[s] + 3 * i, f->pixels + 4 * (size_t)f->to[s][i], 3 * sizeof(float));
    }
    solve(f, scene_count, g);
    double diffuse = 0, lit = 0;
    g->fits = true;
    g->mean = 0;
    for (int c = 0; c < 3; c++) {
        diffuse = g->factors[c][1] > diffuse ? g->factors[c][1] : diffuse;
        lit = g->factors[c][1] + g->factors[c][2] > lit ? g->factors[c][1] + g->factors[c][2] : lit;
        for (int k = 0; k < 3; k++)
            g->fits = g->fits && g->factors[c][k] > -max_negative;
    }
    g->fits = g->fits && diffuse > min_diffuse;
    // reduced if the picture is dark, as with products of small colours
    double tolerance = f->r->tolerance * (lit < 1 ? lit : 1);
    for (int s = 0; s < scene_count; s++) {
        double sum = 0;
        size_t over = 0;
        for (size_t i = 0; i < f->count[s]; i++) {
            const float *b = f->basis[s] + 3 * i, *theirs = f->r->scenes[s].theirs + 4 * (size_t)f->from[s][i];
            double largest = 0;
            for (int c = 0; c < 3; c++) {
                const double *x = g->factors[c];
                double difference = clamped(x[0] * (double)b[0] + x[1] * (double)b[1] + x[2] * (double)b[2]) -
                                    decode(clamped((double)theirs[c]), g->decoded);
                difference = difference < 0 ? -difference : difference;
                sum += difference / 3;
                largest = difference > largest ? difference : largest;
            }
            over += largest > tolerance;
        }
        double mean = f->count[s] ? sum / (double)f->count[s] : 0;
        g->mean += mean / scene_count;
        g->fits = g->fits && (double)over <= 0.005 * (double)f->count[s] + 1 && mean <= tolerance / 4;
    }
    return true;
}

// Measures an interpretation in all scenes if the interpretation fits the first scenes.
static bool try_interpretation(struct fit *f, struct interpretation *g, lam_error *error)
{
    int first = f->r->scene_count < FIRST_SCENES ? f->r->scene_count : FIRST_SCENES;
    return measure(f, first, g, error) && (!g->fits || measure(f, f->r->scene_count, g, error));
}

// --- faults

static bool has_bit(const struct fault *row, enum fault_bit bit)
{
    for (int i = 0; i < MAX_FAULT_BITS && row->bits[i]; i++)
        if (row->bits[i] == bit)
            return true;
    return false;
}

// Adds each fault to each interpretation until a combination explains every scene. `nearest` receives the MAX_NEAREST
// best combinations.
static bool add_faults(struct fit *f, const struct interpretation *interpretations, int count,
                       struct interpretation nearest[MAX_NEAREST], struct interpretation *best, lam_error *error)
{
    for (int i = 0; i < MAX_NEAREST; i++)
        nearest[i] = (struct interpretation){.mean = 1e9};
    for (int m = 0; m < fault_count && !best->fits; m++)
        for (int i = 0; i < count && !best->fits; i++) {
            struct interpretation g = interpretations[i];
            bool early = fault_set_has(&g.set, BIT_LONG_NORMAL_VERTEX) && has_bit(&faults[m], BIT_LONG_NORMAL);
            if (early || !interpretations_allow_fault(&faults[m]) || g.mean >= 1e9 ||
                !fault_applies(&faults[m], &f->r->interface, f->r->interface.light_frame, g.reflection, ~0u))
                continue;
            g.set = fault_set_add(&g.set, &faults[m]);
            if (fault_set_equal(&g.set, &interpretations[i].set))
                continue;
            g.faults[g.fault_count++] = &faults[m];
            if (!try_interpretation(f, &g, error))
                return false;
            if (g.fits)
                *best = g;
            int at = MAX_NEAREST;
            while (at > 0 && g.mean < nearest[at - 1].mean)
                at--;
            if (at < MAX_NEAREST) {
                memmove(&nearest[at + 1], &nearest[at], (size_t)(MAX_NEAREST - 1 - at) * sizeof *nearest);
                nearest[at] = g;
            }
        }
    return true;
}

// Finds the first fault that, with one of the interpretations, explains every scene. If there is none, searches for two
// faults. If the search is successful, `best` fits.
static bool find_faults(struct fit *f, const struct interpretation *interpretations, int count,
                        struct interpretation *best, lam_error *error)
{
    struct interpretation nearest[MAX_NEAREST], unused[MAX_NEAREST];
    return add_faults(f, interpretations, count, nearest, best, error) &&
           (best->fits || add_faults(f, nearest, MAX_NEAREST, unused, best, error));
}

// --- the report

// Draws the references as a correct shader would draw them under this interpretation, with the interpretation's
// factors.
static bool draw_references(struct run *r, const struct interpretation *g, lam_error *error)
{
    size_t pixels = (size_t)r->size * (size_t)r->size;
    struct fault_shader *shader = render_cache_take_shader(r->params->cache, &r->painter, r->size, 1, error);
    bool ok = shader;
    for (int s = 0; ok && s < r->scene_count; s++) {
        float *out = r->scenes[s].reference;
        ok = draw_terms(r, shader, s, g, out, error);
        for (size_t i = 0; ok && i < pixels; i++) {
            float b[3];
            memcpy(b, out + 4 * i, sizeof b);
            for (int c = 0; c < 3; c++) {
                const double *x = g->factors[c];
                double y = x[0] * (double)b[0] + x[1] * (double)b[1] + x[2] * (double)b[2];
                out[4 * i + (size_t)c] = (float)(g->decoded ? math_pow(clamped(y), 1 / 2.2) : y);
            }
        }
    }
    render_cache_keep_shader(r->params->cache, shader);
    return ok;
}

static void report_faults(struct run *r, const struct interpretation *g, double before)
{
    r->report->findings = arena_alloc_zeroed(r->arena, MAX_FAULTS * sizeof *r->report->findings);
    for (int i = 0; r->report->findings && i < g->fault_count; i++) {
        const struct fault *row = g->faults[i];
        char explanation[400], correction[400];
        fault_text(row->explanation, &r->interface, r->interface.light_frame, g->reflection, explanation,
                   sizeof explanation);
        fault_text(row->correction, &r->interface, r->interface.light_frame, g->reflection, correction,
                   sizeof correction);
        r->report->findings[r->report->finding_count++] =
            (lam_check_finding){.mistake = row->id,
                                .explanation = arena_string(r->arena, explanation),
                                .correction = arena_string(r->arena, correction),
                                .certain = true,
                                .mean_before = before,
                                .mean_after = g->mean,
                                .share = 1};
    }
}

static void hint_forms(struct run *r, const struct interpretation *g)
{
    for (int i = 0; i < g->form_count; i++)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s; the contract accepts this form",
                        g->forms[i]->explanation);
    if (g->set.constant > 0)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "lambent takes the exponent of the highlight from the text: %g", (double)g->set.constant);
}

// --- the fit

static int by_mean(const void *a, const void *b)
{
    double x = ((const struct interpretation *)a)->mean, y = ((const struct interpretation *)b)->mean;
    return (x > y) - (x < y);
}

// Lists the interpretations to combine with faults: those that differ from the closest interpretation only in the
// highlight. If the source contains reflect(), the highlight is Phong's.
static int choose_bases(const struct run *r, struct interpretation *interpretations, int count,
                        const struct interpretation *best)
{
    static const enum fault_bit same[] = {BIT_VIEWER_INFINITE, BIT_INVERSE_SQUARE, BIT_INVERSE_DISTANCE,
                                          BIT_DIRECTION_REVERSED, BIT_AMBIENT_ATTENUATED};
    int kept = 0;
    for (int i = 0; i < count; i++) {
        bool fits = interpretations[i].decoded == best->decoded &&
                    (interpretations[i].reflection == LAM_REFLECTION_PHONG || !interpretations_use(r, "reflect"));
        for (size_t k = 0; k < sizeof same / sizeof *same; k++) {
            bool has = fault_set_has(&interpretations[i].set, same[k]);
            fits = fits && (!has || fault_set_has(&best->set, same[k]));
        }
        if (fits)
            interpretations[kept++] = interpretations[i];
    }
    qsort(interpretations, (size_t)kept, sizeof *interpretations, by_mean);
    return kept < MAX_BASES ? kept : MAX_BASES;
}

static bool open_fit(struct fit *f, struct run *r, lam_error *error)
{
    *f = (struct fit){.r = r, .stride = r->size >= 96 ? (r->size + 20) / 43 : r->size >= 70 ? 2 : 1};
    f->size = fault_shader_size(r->size, f->stride);
    size_t small = (size_t)f->size * (size_t)f->size;
    f->pixels = arena_array(r->arena, small, 4 * sizeof(float));
    bool ok =
        f->pixels && (f->shader = render_cache_take_shader(r->params->cache, &r->painter, r->size, f->stride, error));
    for (int s = 0; ok && s < r->scene_count; s++) {
        struct scene_comparison *scene = &r->scenes[s];
        f->from[s] = arena_array(r->arena, small, sizeof(uint32_t));
        f->to[s] = arena_array(r->arena, small, sizeof(uint32_t));
        f->basis[s] = arena_array(r->arena, small, 3 * sizeof(float));
        ok = (f->from[s] && f->to[s] && f->basis[s]) || fail_memory(error, small * 20);
        for (size_t i = 0; ok && i < scene->inside_count; i++) {
            int x = (int)scene->inside[i] % r->size, below = r->size - 1 - (int)scene->inside[i] / r->size;
            if (x % f->stride || below % f->stride)
                continue;
            f->from[s][f->count[s]] = scene->inside[i];
            f->to[s][f->count[s]++] = (uint32_t)((f->size - 1 - below / f->stride) * f->size + x / f->stride);
        }
    }
    return ok;
}

// Finds the pixels to compare. For each scene, computes the share of pixels that the shader does not draw. Sets
// `missing` to the smallest share. A scene whose surfaces face away may be black and transparent.
static bool find_inside(struct run *r, double *missing, lam_error *error)
{
    const struct interpretation plain = {.reflection = LAM_REFLECTION_PHONG};
    for (int s = 0; s < r->scene_count; s++)
        r->scenes[s].reference_scene = shader_interface_scene(&r->interface, r->scenes[s].row);
    if (!draw_references(r, &plain, error))
        return false;
    *missing = 1;
    for (int s = 0; s < r->scene_count; s++) {
        scene_comparison_find_inside(&r->scenes[s], r->size);
        double share = check_missing_share(&r->scenes[s], false);
        *missing = share < *missing ? share : *missing;
    }
    return true;
}

bool check_fit(struct run *r, bool writes, enum fit_outcome *outcome, char *reason, size_t capacity, lam_error *error)
{
    struct fit f = {0};
    double missing = 0;
    *outcome = FIT_UNKNOWN;
    shader_interface_set_counts(&r->interface, r->drawn.group_counts);
    if (!find_inside(r, &missing, error))
        return false;
    if (missing > 0.02) {
        snprintf(reason, capacity, "%.0f %% of the expected model is not drawn", missing * 100);
        return true;
    }
    struct interpretation *interpretations = arena_array(r->arena, MAX_INTERPRETATIONS, sizeof *interpretations),
                          best = {.mean = 1e9};
    if (!interpretations || !open_fit(&f, r, error))
        return interpretations ? false : fail_memory(error, MAX_INTERPRETATIONS * sizeof *interpretations);
    int count = interpretations_list(r, interpretations);
    bool ok = true;
    for (int i = 0; ok && i < count && !best.fits; i++) {
        ok = try_interpretation(&f, &interpretations[i], error);
        if (interpretations[i].fits || interpretations[i].mean < best.mean)
            best = interpretations[i];
    }
    count = choose_bases(r, interpretations, count, &best);
    struct interpretation correct = best;
    double before = best.mean;
    if (ok && count && !best.fits)
        ok = find_faults(&f, interpretations, count, &best, error);
    render_cache_keep_shader(r->params->cache, f.shader);
    if (!ok)
        return false;
    bool plain = !best.fits && best.mean > min_mean && interpretations_are_plain(r);
    if (!best.fits && !plain) {
        snprintf(reason, capacity,
                 "the check cannot explain its pictures as the sum of an ambient, a diffuse and a specular term");
        return true;
    }
    bool explained = best.fault_count > 0;
    if (explained) {
        memcpy(correct.factors, best.factors, sizeof correct.factors);
        correct.reflection = best.reflection;
    }
    if (!draw_references(r, &correct, error))
        return false;
    check_measure(r, writes);
    *outcome = explained ? FIT_EXPLAINED : plain ? FIT_DIFFERS : FIT_RIGHT;
    if (r->report->verdict == LAM_CHECK_NOT_NUMBER)
        *outcome = FIT_EXPLAINED;
    else if ((explained || plain) == (r->report->verdict == LAM_CHECK_PASSES))
        *outcome = FIT_UNKNOWN; // the full pictures do not confirm the interpretation
    if (*outcome == FIT_UNKNOWN)
        snprintf(reason, capacity, "its pictures resemble a correct shader's pictures, but are not equal to them");
    else if (explained)
        report_faults(r, &best, before);
    if (*outcome == FIT_DIFFERS)
        check_describe(r);
    if (*outcome == FIT_RIGHT)
        hint_forms(r, &best);
    return true;
}
