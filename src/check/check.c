// check.c: runs a check: parses the shaders, draws, compares, searches for faults, reports.
#include "default_vertex_shader.h"
#include "compiler_hints.h"
#include "fault_search.h"
#include "shader_diagnostics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "srgb.h"
#include "spelling.h"

struct run {
    const lam_check_params *params;
    lam_check_report *report;
    struct arena *arena;
    struct diagnostics diagnostics;
    struct shader_interface interface;
    int size;
    double tolerance;
    lam_light_frame frame;
    lam_reflection reflection;
    char *vertex;    // generated, where none was given
    lam_bytes bytes; // the drawing process's message, which `drawn` points into
    struct draw_result drawn;
    struct scene_comparison *scenes;
    int scene_count;
};

// --- preparation

static bool choose_scenes(struct run *r, unsigned *scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    *scenes = 0;
    for (int i = 0; i < reference_scene_count; i++) {
        bool asked = p->scenes == NULL;
        for (int k = 0; p->scenes && k < p->scene_count; k++)
            asked |= strcmp(p->scenes[k], reference_scenes[i].name) == 0;
        if (asked && (reference_scenes[i].needs & ~r->interface.supports) == 0)
            *scenes |= 1u << i;
        else if (asked && p->scenes)
            return fail(error, LAM_BAD_ARGUMENT,
                        "scene '%s': the shader lacks names of the contract %s that the scene needs",
                        reference_scenes[i].name, r->interface.contract->name);
    }
    for (int k = 0; p->scenes && k < p->scene_count; k++)
        if (reference_scene_find(p->scenes[k]) < 0) {
            const char *names[32];
            for (int i = 0; i < reference_scene_count; i++)
                names[i] = reference_scenes[i].name;
            const char *near = nearest_word(p->scenes[k], names, reference_scene_count);
            return fail(error, LAM_BAD_ARGUMENT, "unknown scene '%.60s'%s%s%s; `lambent check --list` prints all names",
                        p->scenes[k], near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
        }
    return true;
}

static bool prepare(struct run *r, unsigned *scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    if (!p->fragment)
        return fail(error, LAM_BAD_ARGUMENT, "check: no fragment shader given");
    r->size = p->size ? p->size : 128;
    if (r->size < 32 || r->size > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "check: pictures of %d pixels, expected 32 to 1024", r->size);
    r->tolerance = p->tolerance > 0 ? p->tolerance : 2.0 / 255;
    if (!shader_interface_make(&r->interface, p->vertex, p->fragment, p->contract, error))
        return false;
    r->frame = p->light_frame == LAM_FRAME_WORLD ? r->interface.contract->light_frame : p->light_frame;
    r->reflection = p->reflection != LAM_REFLECTION_AUTO ? p->reflection
                    : r->interface.phong                 ? LAM_REFLECTION_PHONG
                                                         : r->interface.contract->reflection;
    if (r->reflection != LAM_REFLECTION_PHONG && r->reflection != LAM_REFLECTION_BLINN_PHONG)
        return fail(error, LAM_BAD_ARGUMENT, "check: unknown highlight, expected phong or blinn-phong");
    if (!p->vertex) {
        char unknown[256];
        r->vertex = default_vertex_shader(&r->interface, unknown, error);
        if (!r->vertex)
            return false;
        r->report->made_vertex = true;
        if (unknown[0])
            diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, p->fragment_name, 0,
                            "no vertex shader is given, and the names do not say which values %s should have; zero is "
                            "used; give the vertex shader with --vertex",
                            unknown);
    }
    return choose_scenes(r, scenes, error);
}

// --- drawing

static bool draw_here(struct run *r, const lam_bytes *request, lam_error *error)
{
    return lam_check_draw(request->data, request->size, r->params->gl_device, &r->bytes, error);
}

// False: no verdict is possible. A process that timed out or crashed sets the report's verdict.
static bool draw(struct run *r, unsigned scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    struct draw_request request = {.contract = r->interface.which,
                                   .light_frame = r->frame,
                                   .size = r->size,
                                   .scenes = scenes,
                                   .vertex = p->vertex ? p->vertex : r->vertex,
                                   .fragment = p->fragment};
    lam_bytes bytes = {0};
    if (!draw_request_write(&request, &bytes, error))
        return false;
    bool ok = true;
    if (p->draw)
        switch (p->draw(p->user, &bytes, &r->bytes, error)) {
        case LAM_CHECK_DRAW_DONE:
            break;
        case LAM_CHECK_DRAW_TIMEOUT:
            r->report->verdict = LAM_CHECK_ENDLESS;
            break;
        case LAM_CHECK_DRAW_CRASHED:
            r->report->verdict = LAM_CHECK_CRASHES;
            break;
        default:
            ok = false;
            break;
        }
    else
        ok = draw_here(r, &bytes, error);
    lam_bytes_free(&bytes);
    if (!ok || r->report->verdict != LAM_CHECK_PASSES)
        return ok;
    if (!draw_result_read(&r->bytes, r->size, &r->drawn, error))
        return false;
    snprintf(r->report->driver, sizeof r->report->driver, "%s", r->drawn.driver);
    if (r->drawn.state == DRAWN_SLOW) {
        r->report->verdict = LAM_CHECK_ENDLESS;
        diagnostics_add(
            &r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
            "scene '%.30s' took %.2g s of processor time, where a correct shader takes milliseconds: is there "
            "an endless loop? Some drivers leave it after many iterations, others hang",
            r->drawn.log, r->drawn.seconds);
    } else if (r->drawn.state != DRAWN_PICTURES) {
        r->report->verdict = LAM_CHECK_REFUSED;
        diagnostics_add_refusal(&r->diagnostics, &r->drawn, &r->interface, p);
    }
    return true;
}

// --- the reference

static void find_inside(struct scene_comparison *scene, int size)
{
    for (int y = 1; y + 1 < size; y++)
        for (int x = 1; x + 1 < size; x++) {
            bool all = true;
            for (int k = 0; k < 9; k++) {
                size_t at = (size_t)(y + k / 3 - 1) * (size_t)size + (size_t)(x + k % 3 - 1);
                all = all && scene->reference[4 * at + 3] > 0;
            }
            if (all)
                scene->inside[scene->inside_count++] = (uint32_t)(y * size + x);
        }
}

static bool draw_reference(struct run *r, lam_device *device, struct scene_comparison *scene, lam_error *error)
{
    lam_camera camera;
    struct reference_scene opaque = scene->reference_scene; // the shader under test is drawn without blending
    opaque.alpha = 1;
    lam_scene *world = reference_to_scene(&opaque, &camera, error);
    lam_image image = {0};
    bool two_sides = (r->interface.supports & NEED_TWO_SIDES) != 0;
    lam_draw_params draw = {
        .samples = 1,
        .rig = LAM_RIG_NONE,
        .reflection = r->reflection,
        .shading = scene->reference_scene.flat ? LAM_SHADING_FLAT
                   : r->interface.vertex_lit   ? LAM_SHADING_GOURAUD
                                               : LAM_SHADING_PHONG,
        .flat_normal = LAM_FLAT_NORMAL_VERTEX,
    };
    if (world && !two_sides) {
        lam_object object = *lam_scene_object(world, 0);
        object.one_sided = true;
        lam_scene_set_object(world, 0, &object, NULL);
    }
    bool ok = world && lam_image_make(&image, r->size, r->size, LAM_RGBA32F, error) &&
              lam_draw(device, world, &camera, &draw, &image, NULL, error);
    if (ok) {
        scene->reference = image.pixels; // owned by the report
        for (size_t i = 0; i < (size_t)r->size * (size_t)r->size; i++)
            scene->reference[4 * i + 3] *= scene->reference_scene.alpha;
        find_inside(scene, r->size);
    } else {
        lam_image_free(&image);
    }
    lam_scene_free(world);
    return ok;
}

static bool make_scenes(struct run *r, unsigned scenes, lam_error *error)
{
    size_t pixels = (size_t)r->size * (size_t)r->size, at = 0;
    int lights = r->drawn.has_list ? r->drawn.light_count : 1;
    lam_device *device = lam_device_cpu(NULL, error);
    r->scenes = arena_alloc_zeroed(r->arena, (size_t)reference_scene_count * sizeof *r->scenes);
    r->report->scenes = arena_alloc_zeroed(r->arena, (size_t)reference_scene_count * sizeof *r->report->scenes);
    bool ok = device && r->scenes && r->report->scenes;
    for (int i = 0; ok && i < reference_scene_count; i++) {
        if (!(scenes >> i & 1))
            continue;
        struct scene_comparison *scene = &r->scenes[r->scene_count++];
        scene->row = &reference_scenes[i];
        scene->reference_scene =
            contract_reference_scene(r->interface.contract, r->interface.supports, &reference_scenes[i], lights);
        scene->theirs = r->drawn.pixels + at;
        scene->alpha = reference_scenes[i].needs & NEED_ALPHA;
        scene->inside = arena_array(r->arena, pixels, sizeof *scene->inside);
        scene->samples = arena_array(r->arena, pixels, 4 * sizeof *scene->samples);
        ok = scene->inside && scene->samples && draw_reference(r, device, scene, error);
        lam_check_scene *out = &r->report->scenes[r->report->scene_count++];
        *out = (lam_check_scene){
            .name = scene->row->name,
            .description = scene->row->description,
            .reference = {
                .width = r->size, .height = r->size, .format = LAM_RGBA32F, .owned = true, .pixels = scene->reference}};
        ok = ok && lam_image_make(&out->theirs, r->size, r->size, LAM_RGBA32F, error);
        if (ok)
            memcpy(out->theirs.pixels, scene->theirs, pixels * 4 * sizeof(float));
        at += 4 * pixels;
    }
    lam_device_free(device);
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

// Whether the shader encodes its colours as sRGB, as those of `lambent shader` do: the constant 12.92 of the encoding
// occurs in its text. Its pictures are then decoded before they are compared.
static bool is_encoded(const struct run *r)
{
    return r->interface.which == LAM_CONTRACT_LAMBENT && declarations_uses(&r->interface.fragment, "12.92");
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

// `numbers`: scratch memory for the samples of a picture.
static void measure(struct run *r, bool writes, float *numbers)
{
    lam_check_report *report = r->report;
    for (int i = 0; i < r->scene_count; i++) {
        lam_check_scene *out = &report->scenes[i];
        fault_search_sample(&r->scenes[i], r->scenes[i].theirs, r->scenes[i].samples);
        fault_search_sample(&r->scenes[i], r->scenes[i].reference, numbers);
        struct difference d = fault_search_difference(&r->scenes[i], numbers, r->tolerance);
        r->scenes[i].mean_difference = d.mean;
        r->scenes[i].passes = d.fits;
        out->maximum = d.maximum;
        out->mean = d.mean;
        out->share_over = d.share_over;
        out->pixels = d.pixels;
        out->not_numbers = count_not_numbers(r->scenes[i].theirs, (size_t)r->size * (size_t)r->size);
        out->passes = d.fits && out->not_numbers == 0;
        report->mean += d.mean / r->scene_count;
        if (!out->passes && report->verdict == LAM_CHECK_PASSES)
            report->verdict = LAM_CHECK_DIFFERS;
        if (out->not_numbers)
            report->verdict = LAM_CHECK_NOT_NUMBER;
    }
    if (report->verdict == LAM_CHECK_NOT_NUMBER && writes)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "NaN or infinity reaches the picture: pow() of a negative base, normalize() of a zero "
                        "vector and division by 0 produce it; pow(max(x, 0.0), shininess) does not");
}

// Fraction of the compared pixels that are unwritten, or NaN or infinite.
static double missing_share(const struct scene_comparison *scene, bool not_numbers)
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

// Whether a search for faults makes sense: not for pictures that are nearly empty.
static bool is_searchable(struct run *r, bool writes)
{
    double clear = 0, no_number = 0;
    bool spoilt = false; // NaN counts as black, so such a scene resembles faults that darken
    for (int i = 0; i < r->scene_count; i++) {
        double here = missing_share(&r->scenes[i], true);
        clear += missing_share(&r->scenes[i], false) / r->scene_count;
        no_number += here / r->scene_count;
        spoilt = spoilt || here > 0.25;
    }
    if (writes && clear > 0.02)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "%.0f %% of the model is not drawn: the shader discards it, or gl_Position puts it elsewhere",
                        clear * 100);
    return writes && clear < 0.9 && no_number < 0.5 && !spoilt;
}

// Whether the pictures differ by more than NaN and infinity, which count as 0 and 1.
static bool has_differences(const struct run *r)
{
    bool fits = true;
    for (int i = 0; i < r->scene_count; i++)
        fits = fits && r->scenes[i].passes;
    return !fits;
}

static bool explain(struct run *r, lam_error *error)
{
    lam_check_report *report = r->report;
    struct fault_search s = {.interface = &r->interface,
                             .frame = r->frame,
                             .reflection = r->reflection,
                             .gl_device = r->params->gl_device,
                             .cache = r->params->cache,
                             .scenes = r->scenes,
                             .scene_count = r->scene_count,
                             .size = r->size,
                             .light_capacity = r->drawn.has_list ? r->drawn.light_count : 1,
                             .tolerance = r->tolerance,
                             .before = report->mean,
                             .has_unset_names = r->drawn.unknown_count > 0 || r->drawn.types_count > 0};
    for (int i = 0; i < r->scene_count; i++)
        s.needs |= r->scenes[i].row->needs;
    for (int i = 0; i < r->scene_count; i++) // some scenes show more than they need
        s.needs |=
            (r->scenes[i].reference_scene.ka > 0 ? NEED_AMBIENT : 0) |
            (r->interface.contract->has_attenuation && (r->interface.supports & NEED_POINT) ? NEED_ATTENUATION : 0);
    s.scene_faults = arena_alloc_zeroed(r->arena, (size_t)r->scene_count * sizeof *s.scene_faults + 1);
    if (!s.scene_faults)
        return fail_memory(error, 1);
    if (!fault_search_run(&s, error))
        return false;
    if (s.has_unset_names)
        diagnostics_add(
            &r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
            "a name that is not in the contract has the value 0, which may be the only mistake: correct the "
            "names first");
    report->findings = arena_alloc_zeroed(r->arena, MAX_FOUND_FAULTS * sizeof *report->findings);
    for (int i = 0; report->findings && i < s.count; i++) {
        char explanation[400], correction[400];
        fault_text(s.found[i]->explanation, &r->interface, r->frame, r->reflection, explanation, sizeof explanation);
        fault_text(s.found[i]->correction, &r->interface, r->frame, r->reflection, correction, sizeof correction);
        report->findings[report->finding_count++] =
            (lam_check_finding){.mistake = s.found[i]->id,
                                .explanation = arena_string(r->arena, explanation),
                                .correction = arena_string(r->arena, correction),
                                .certain = s.certain,
                                .mean_before = i ? s.after[i - 1] : s.before,
                                .mean_after = s.after[i]};
    }
    for (int i = 0; i < r->scene_count; i++)
        if (!report->scenes[i].passes && s.scene_faults[i])
            report->scenes[i].looks_like = s.scene_faults[i]->id;
    return true;
}

bool lam_check_run(const lam_check_params *params, lam_check_report *report, lam_error *error)
{
    *report = (lam_check_report){0};
    if (!check_reserved("lam_check_params", params, error))
        return false;
    struct run r = {.params = params, .report = report};
    r.arena = report->memory = calloc(1, sizeof *r.arena);
    if (!r.arena)
        return fail_memory(error, sizeof *r.arena);
    arena_start(r.arena, NULL);
    r.diagnostics.arena = r.arena;
    unsigned scenes = 0;
    bool ok = prepare(&r, &scenes, error) && draw(&r, scenes, error);
    if (ok) {
        report->contract = r.interface.which;
        report->vertex_lit = r.interface.vertex_lit;
        diagnostics_add_names(&r.diagnostics, &r.drawn, &r.interface, params);
    }
    if (ok && report->verdict == LAM_CHECK_PASSES) {
        ok = make_scenes(&r, scenes, error);
        if (ok && is_encoded(&r))
            ok = decode_all(&r);
        float *numbers = ok ? arena_array(r.arena, (size_t)r.size * (size_t)r.size, 4 * sizeof *numbers) : NULL;
        ok = ok && (numbers || fail_memory(error, 1));
        bool writes = !ok || compiler_hints_for_output(&r.diagnostics, &r.interface.fragment, params->fragment_name);
        if (ok)
            measure(&r, writes, numbers);
        if (ok && report->verdict != LAM_CHECK_PASSES && is_searchable(&r, writes) && has_differences(&r))
            ok = explain(&r, error);
    }
    if (ok && r.diagnostics.failed)
        ok = fail_memory(error, 1);
    report->diagnostics = r.diagnostics.items;
    report->diagnostic_count = r.diagnostics.count;
    shader_interface_free(&r.interface);
    free(r.vertex);
    lam_bytes_free(&r.bytes);
    if (!ok)
        lam_check_report_free(report);
    return ok;
}

void lam_check_report_free(lam_check_report *report)
{
    for (int i = 0; i < report->scene_count; i++) {
        lam_image_free(&report->scenes[i].theirs);
        lam_image_free(&report->scenes[i].reference);
    }
    if (report->memory)
        arena_free(report->memory);
    free(report->memory);
    *report = (lam_check_report){0};
}

const char *lam_check_verdict_name(lam_check_verdict verdict)
{
    static const char *const names[] = {"passes", "differs", "refused", "endless", "crashes", "not a number"};
    return verdict >= LAM_CHECK_PASSES && verdict <= LAM_CHECK_NOT_NUMBER ? names[verdict] : NULL;
}

const char *lam_check_scene_name(int index)
{
    return index >= 0 && index < reference_scene_count ? reference_scenes[index].name : NULL;
}

const char *lam_check_scene_description(int index)
{
    return index >= 0 && index < reference_scene_count ? reference_scenes[index].description : NULL;
}
