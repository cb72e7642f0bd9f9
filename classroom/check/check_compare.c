// check_compare.c: compares the shader's pictures with the references, and finds the mistakes that explain a
// difference.
#include "check_run.h"

#include <stdio.h>
#include <string.h>

#include "arena.h"
#include "expectation.h"
#include "fail.h"
#include "fault_search.h"
#include "srgb.h"

// With a software driver on one processor, a search of this size takes some seconds (docs/check.md).
static const uint64_t default_max_pictures = 10000;
// If the names suggested the contract, the shader is evaluated too (check_doubt), and a long search is not worth its time.
static const uint64_t max_pictures_of_guess = 2500;
static const double max_dark = 2.0 / 255; // the largest value in a picture that is treated as black

// --- the pictures

bool check_make_scenes(struct run *r, unsigned scenes, lam_error *error)
{
    size_t pixels = (size_t)r->size * (size_t)r->size, at = 0;
    r->scenes = arena_alloc_zeroed(r->arena, (size_t)reference_scene_count * sizeof *r->scenes);
    r->report->scenes = arena_alloc_zeroed(r->arena, (size_t)reference_scene_count * sizeof *r->report->scenes);
    r->numbers = arena_array(r->arena, pixels, 4 * sizeof *r->numbers);
    bool ok = (r->scenes && r->report->scenes && r->numbers) || fail_memory(error, pixels * 4 * sizeof(float));
    for (int i = 0; ok && i < reference_scene_count; i++) {
        if (!(scenes >> i & 1))
            continue;
        struct scene_comparison *scene = &r->scenes[r->scene_count++];
        scene->row = &reference_scenes[i];
        scene->theirs = r->drawn.pixels + at;
        scene->alpha = reference_scenes[i].needs & NEED_ALPHA;
        scene->inside = arena_array(r->arena, pixels, sizeof *scene->inside);
        scene->samples = arena_array(r->arena, pixels, 4 * sizeof *scene->samples);
        lam_check_scene *out = &r->report->scenes[r->report->scene_count++];
        *out = (lam_check_scene){.name = scene->row->name, .description = scene->row->description};
        ok = ((scene->inside && scene->samples) || fail_memory(error, pixels * 4 * sizeof(float))) &&
             lam_image_make(&out->reference, r->size, r->size, LAM_RGBA32F, error) &&
             lam_image_make(&out->theirs, r->size, r->size, LAM_RGBA32F, error);
        scene->reference = out->reference.pixels;
        if (ok)
            memcpy(out->theirs.pixels, scene->theirs, pixels * 4 * sizeof(float));
        at += 4 * pixels;
    }
    return ok;
}

// --- the verdict

static uint64_t count_not_numbers(const float *pixels, size_t count)
{
    uint64_t found = 0;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 4; c++) {
            float x = pixels[4 * i + (size_t)c];
            if (!(x - x == 0)) {
                found++;
                break;
            }
        }
    return found;
}

static float decode(float encoded) { return (float)srgb_linear((double)encoded); }

// Returns whether the shader encodes its colours as sRGB, like the shaders that `lambent shader` prints. The source of
// such a shader contains the encoding's constant 12.92. The shader's pictures are decoded before they are compared.
static bool is_encoded(const struct run *r)
{
    return r->interface.contract->printed && declarations_uses(&r->interface.fragment, "12.92");
}

static bool decode_all(struct run *r)
{
    size_t count = 4 * (size_t)r->size * (size_t)r->size;
    for (int k = 0; k < r->scene_count; k++) {
        float *decoded = arena_array(r->arena, count, sizeof *decoded);
        if (!decoded)
            return false;
        for (size_t i = 0; i < count; i++)
            decoded[i] = i % 4 == 3 ? r->scenes[k].theirs[i] : decode(r->scenes[k].theirs[i]);
        r->scenes[k].theirs = decoded;
        memcpy(r->report->scenes[k].theirs.pixels, decoded, count * sizeof *decoded);
    }
    return true;
}

static bool is_black(lam_rgb c, float strength) { return strength == 0 || (c.r == 0 && c.g == 0 && c.b == 0); }

static unsigned terms_of(const struct reference_scene *s)
{
    bool ambient = false, diffuse = false, specular = false;
    for (int i = 0; i < s->light_count; i++) {
        ambient = ambient || !is_black(s->lights[i].ambient, 1);
        diffuse = diffuse || !is_black(s->lights[i].color, 1);
        specular = specular || !is_black(s->lights[i].specular, 1);
    }
    return (ambient && !is_black(s->ambient, s->ka) ? LAM_CHECK_TERM_AMBIENT : 0u) |
           (diffuse && !is_black(s->diffuse, s->kd) ? LAM_CHECK_TERM_DIFFUSE : 0u) |
           (specular && !is_black(s->specular, s->ks) ? LAM_CHECK_TERM_SPECULAR : 0u);
}

// Compares every scene with its reference, and sets the verdict.
void check_measure(struct run *r)
{
    lam_check_report *report = r->report;
    report->verdict = LAM_CHECK_PASSES;
    report->mean = 0;
    for (int i = 0; i < r->scene_count; i++) {
        lam_check_scene *out = &report->scenes[i];
        scene_comparison_sample(&r->scenes[i], r->scenes[i].theirs, r->scenes[i].samples);
        scene_comparison_sample(&r->scenes[i], r->scenes[i].reference, r->numbers);
        struct difference d = scene_comparison_difference(&r->scenes[i], r->numbers, r->tolerance);
        r->scenes[i].mean_difference = d.mean;
        r->scenes[i].passes = d.fits;
        out->maximum = d.maximum;
        out->mean = d.mean;
        out->share_over = d.share_over;
        out->pixels = d.pixels;
        out->not_numbers = count_not_numbers(r->scenes[i].theirs, (size_t)r->size * (size_t)r->size);
        out->passes = d.fits && out->not_numbers == 0;
        out->terms = terms_of(&r->scenes[i].reference_scene);
        report->mean += d.mean / r->scene_count;
        if (!out->passes && report->verdict == LAM_CHECK_PASSES)
            report->verdict = LAM_CHECK_DIFFERS;
        if (out->not_numbers)
            report->verdict = LAM_CHECK_NOT_NUMBER;
    }
    if (report->verdict == LAM_CHECK_NOT_NUMBER && r->writes_colour)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "NaN or infinity reaches the picture: pow() of a negative base, normalize() of a zero "
                        "vector and division by 0 produce it; pow(max(x, 0.0), shininess) does not");
}

// Returns the fraction of the compared pixels that are unwritten, or NaN or infinite.
double check_missing_share(const struct scene_comparison *scene, bool not_numbers)
{
    size_t missing = 0;
    for (size_t i = 0; i < scene->inside_count; i++) {
        const float *p = scene->theirs + 4 * (size_t)scene->inside[i];
        bool clear = p[0] == 0 && p[1] == 0 && p[2] == 0 && p[3] == 0, number = true;
        for (int c = 0; c < 4; c++)
            number = number && p[c] - p[c] == 0;
        missing += not_numbers ? !number : clear;
    }
    return scene->inside_count ? (double)missing / (double)scene->inside_count : 0;
}

static bool is_dark(const struct scene_comparison *scene, const float *picture)
{
    for (size_t i = 0; i < scene->inside_count; i++)
        for (int c = 0; c < 3; c++)
            if ((double)picture[4 * (size_t)scene->inside[i] + (size_t)c] > max_dark)
                return false;
    return true;
}

// A black picture of a black scene proves nothing. A black scene scores no points if the shader fails in another scene.
// If all reference pictures are black, the program reports no verdict.
static bool weigh_darkness(struct run *r, lam_error *error)
{
    bool lit = false;
    for (int i = 0; i < r->scene_count; i++) {
        bool dark = is_dark(&r->scenes[i], r->scenes[i].reference);
        lit = lit || !dark;
        if (dark && r->report->verdict != LAM_CHECK_PASSES)
            r->report->scenes[i].passes = false;
    }
    return lit || r->report->verdict == LAM_CHECK_NOT_NUMBER || r->interface.printed_model == LAM_REFLECTION_NONE ||
           fail(error, LAM_BAD_ARGUMENT,
                "no verdict: the shader declares no colour, strength or light of the contract %s, so nothing can be "
                "lit; `undeclared` in a contract sets their values (docs/check/contract-file.md)",
                r->interface.contract->name);
}

// Returns whether a search for faults is useful. A search is useless for nearly empty pictures. Scenes with many NaN
// values are excluded, because NaN is treated as black and would look like a fault that darkens the picture.
static bool is_searchable(struct run *r)
{
    double clear = 0;
    int usable = 0;
    lam_reflection model = r->interface.printed_model, highlight = r->interface.contract->reflection;
    bool form = !r->interface.infinite_viewer && !r->interface.gl1;
    bool known =
        form &&
        (model == LAM_REFLECTION_AUTO || model == LAM_REFLECTION_PHONG || model == LAM_REFLECTION_BLINN_PHONG ||
         (model == LAM_REFLECTION_GGX && !r->interface.multiple_scattering)) &&
        highlight != LAM_REFLECTION_TOON && highlight != LAM_REFLECTION_GOOCH;
    if (!known)
        diagnostics_add(
            &r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
            "lambent does not search for mistakes in this shader: the search supports only "
            "Lambert, Phong, Blinn-Phong and GGX with --single-scattering, without --gl1 and --viewer infinite");
    for (int i = 0; i < r->scene_count; i++) {
        clear += check_missing_share(&r->scenes[i], false) / r->scene_count;
        r->scenes[i].spoilt = check_missing_share(&r->scenes[i], true) > 0.25;
        usable += !r->scenes[i].spoilt && !r->scenes[i].passes;
    }
    if (r->writes_colour && clear > 0.02)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "%.0f %% of the model is not drawn: the shader discards it, or gl_Position moves it elsewhere",
                        clear * 100);
    return r->writes_colour && known && clear < 0.9 && usable > 0;
}

// Finds the styles that the shader uses, and compares the shader with pictures drawn in these styles. The styles are as
// correct as the reference.
static bool accept_styles(struct run *r, struct fault_search *s, lam_error *error)
{
    if (s->count == 0)
        for (int i = 0; i < r->scene_count; i++)
            if (!r->scenes[i].passes && !fault_search_draw_style(s, i, r->scenes[i].reference, error))
                return false;
    for (int i = 0; i < s->style_count; i++)
        diagnostics_add(
            &r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s%s%s", s->styles[i]->explanation,
            s->styles[i]->demand ? "; the contract accepts this form: " : "",
            s->styles[i]->demand == DEMAND_GATE           ? "it does not contain \"gate\": \"required\""
            : s->styles[i]->demand == DEMAND_UNIT_NORMALS ? "it does not contain \"unit_normals\": \"required\""
            : s->styles[i]->demand == DEMAND_BARE_AMBIENT ? "it does not contain \"bare_ambient\": \"required\""
                                                          : "");
    if (s->count == 0)
        check_measure(r);
    return true;
}

// Returns the ids of the other faults that result in the same pictures, separated by blanks, or NULL if there are none.
static const char *also_text(struct run *r, const struct found_fault *found)
{
    char text[200] = "";
    for (int i = 0; i < found->also_count; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s", i ? " " : "", found->also[i]->id);
    return text[0] ? arena_string(r->arena, text) : NULL;
}

static void report_findings(struct run *r, const struct fault_search *s)
{
    lam_check_report *report = r->report;
    for (int i = 0; i < s->count && s->count > 1 && !r->params->contract; i++)
        if (s->found[i].row->whole_term)
            return; // the names only suggested the contract, whose terms the shader may not need
    report->findings = arena_alloc_zeroed(r->arena, MAX_FOUND_FAULTS * sizeof *report->findings);
    for (int i = 0; report->findings && i < s->count; i++) {
        char explanation[400], correction[400];
        const struct found_fault *found = &s->found[i];
        if (s->count > 1 && expectation_permits(&r->interface, r->params->terms, found->row->id))
            continue;
        fault_text(found->row->explanation, &r->interface, r->frame, r->reflection, explanation, sizeof explanation);
        fault_text(found->row->correction, &r->interface, r->frame, r->reflection, correction, sizeof correction);
        size_t at = strlen(explanation);
        double number = found->row->fit == FIT_SMALLER ? 1 / (double)found->exponent : (double)found->exponent;
        if (found->row->fit)
            snprintf(explanation + at, sizeof explanation - at, ", here %.3g", number);
        double before = i ? s->found[i - 1].after : s->before;
        report->findings[report->finding_count++] =
            (lam_check_finding){.mistake = found->row->id,
                                .explanation = arena_string(r->arena, explanation),
                                .correction = arena_string(r->arena, correction),
                                .also = also_text(r, found),
                                .certain = s->certain,
                                .mean_before = before,
                                .mean_after = found->after,
                                .share = s->certain && i == s->count - 1 ? 1
                                         : found->after < s->before      ? 1 - found->after / s->before
                                                                         : 0};
    }
    for (int i = 0; i < r->scene_count; i++)
        if (!report->scenes[i].passes && s->scene_faults[i] &&
            !expectation_permits(&r->interface, r->params->terms, s->scene_faults[i]->id))
            report->scenes[i].looks_like = s->scene_faults[i]->id;
}

static bool explain(struct run *r, lam_error *error)
{
    struct fault_search s = {.interface = &r->interface,
                             .frame = r->frame,
                             .reflection = r->reflection,
                             .painter = &r->painter,
                             .cache = r->params->cache,
                             .scenes = r->scenes,
                             .scene_count = r->scene_count,
                             .size = r->size,
                             .light_capacity = shader_interface_light_count(&r->interface),
                             .expectation = r->expectation,
                             .tolerance = r->tolerance,
                             .max_pictures = r->params->max_pictures                        ? r->params->max_pictures
                                             : r->params->contract || r->interface.physical ? default_max_pictures
                                                                                            : max_pictures_of_guess,
                             .has_unset_names = r->drawn.unknown_count > 0 || r->drawn.types_count > 0};
    int usable = 0;
    for (int i = 0; i < r->scene_count; i++) {
        s.needs |= r->scenes[i].row->needs;
        s.before += r->scenes[i].spoilt ? 0 : r->scenes[i].mean_difference;
        usable += !r->scenes[i].spoilt;
    }
    s.before /= usable;
    for (int i = 0; i < r->scene_count; i++) // some scenes show the tested feature together with other features
        s.needs |=
            (r->scenes[i].reference_scene.ka > 0 ? NEED_AMBIENT : 0) |
            (r->interface.contract->has_attenuation && (r->interface.supports & NEED_POINT) ? NEED_ATTENUATION : 0);
    s.scene_faults = arena_alloc_zeroed(r->arena, (size_t)r->scene_count * sizeof *s.scene_faults + 1);
    if (!s.scene_faults)
        return fail_memory(error, 1);
    if (!fault_search_run(&s, error))
        return false;
    r->report->tried = s.tried;
    r->report->search_stopped = s.stopped;
    if (s.style_count && !accept_styles(r, &s, error))
        return false;
    if (r->report->verdict == LAM_CHECK_PASSES)
        return true;
    if (s.has_unset_names)
        diagnostics_add(
            &r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
            "a name that is not in the contract has the value 0, which may be the only mistake: correct the "
            "names first");
    report_findings(r, &s);
    if (!r->report->finding_count && !s.has_unset_names)
        check_describe(r);
    return true;
}

bool check_compare(struct run *r, unsigned scenes, lam_error *error)
{
    shader_interface_set_counts(&r->interface, r->drawn.group_counts);
    if (!check_make_scenes(r, scenes, error))
        return false;
    if (is_encoded(r) && !decode_all(r))
        return fail_memory(error, 4 * (size_t)r->size * (size_t)r->size * sizeof(float));
    if (!check_draw_references(r, error))
        return false;
    check_measure(r);
    if (!weigh_darkness(r, error))
        return false;
    if (r->report->verdict == LAM_CHECK_PASSES || !is_searchable(r))
        return true;
    return explain(r, error);
}
