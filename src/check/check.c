// check.c: runs a check: parses the shaders, draws, and has the pictures compared.
#include "check_run.h"
#include "compiler_hints.h"
#include "default_vertex_shader.h"
#include "shader_diagnostics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "spelling.h"

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

// The names of the shaders' uniforms, for messages.
static void list_uniforms(const struct declarations *d, char *out, size_t capacity)
{
    for (int i = 0; i < d->count; i++) {
        size_t used = strlen(out);
        if (d->items[i].kind == DECLARED_UNIFORM && used + 60 < capacity)
            snprintf(out + used, capacity - used, "%s%.40s", used ? ", " : "", d->items[i].name);
    }
}

// The contract that is given, or that has the shaders' names. NULL: see `error`.
static const struct contract *choose_contract(struct run *r, lam_error *error)
{
    const lam_check_params *p = r->params;
    struct declarations vertex = {0}, fragment = {0};
    if (p->contract)
        return &p->contract->contract;
    const struct contract *found = NULL;
    if (contracts_read(r->shipped, &r->shipped_count, error) &&
        declarations_read(&vertex, p->vertex ? p->vertex : "", true, error) &&
        declarations_read(&fragment, p->fragment, false, error)) {
        found = contract_recognise(r->shipped, r->shipped_count, &vertex, &fragment);
        char uniforms[200] = "";
        list_uniforms(&vertex, uniforms, sizeof uniforms);
        list_uniforms(&fragment, uniforms, sizeof uniforms);
        if (!found)
            fail(error, LAM_BAD_ARGUMENT,
                 "no uniform or attribute of the shader has a name of a known contract (found %s); `lambent check "
                 "--list` prints them, and --contract names another or a file",
                 uniforms[0] ? uniforms : "none");
    }
    declarations_free(&vertex);
    declarations_free(&fragment);
    return found;
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
    const struct contract *contract = choose_contract(r, error);
    if (!contract || !shader_interface_make(&r->interface, p->vertex, p->fragment, contract, error))
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
    struct draw_request request = {.contract = r->interface.contract->text,
                                   .light_frame = p->light_frame,
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
        report->contract = arena_string(r.arena, r.interface.contract->name);
        report->vertex_lit = r.interface.vertex_lit;
        diagnostics_add_names(&r.diagnostics, &r.drawn, &r.interface, params);
    }
    if (ok && report->verdict == LAM_CHECK_PASSES) {
        bool writes = compiler_hints_for_output(&r.diagnostics, &r.interface.fragment, params->fragment_name);
        ok = check_compare(&r, scenes, writes, error);
    }
    if (ok && r.diagnostics.failed)
        ok = fail_memory(error, 1);
    report->diagnostics = r.diagnostics.items;
    report->diagnostic_count = r.diagnostics.count;
    shader_interface_free(&r.interface);
    for (int i = 0; i < r.shipped_count; i++)
        lam_check_contract_free(r.shipped[i]);
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
