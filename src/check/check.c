// check.c: runs a check: parses the shaders, draws, and has the pictures compared.
#include "check_run.h"
#include "check_draw.h"
#include "compiler_hints.h"
#include "default_vertex_shader.h"
#include "gl_painter.h"
#include "recognise.h"
#include "shader_diagnostics.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "spelling.h"

// --- preparation

// A scene as the shaders can express it, without what its terms do not show.
static struct reference_scene visible_scene(const struct run *r, int index)
{
    struct reference_scene s = shader_interface_scene(&r->interface, &reference_scenes[index]);
    for (int i = 0; i < s.light_count; i++) {
        if (s.ks == 0)
            s.lights[i].specular = (lam_rgb){0, 0, 0};
        if (s.lights[i].type == LAM_LIGHT_DIRECTIONAL)
            s.lights[i].position = (lam_vec3){0, 0, 0};
    }
    if (s.ks == 0) {
        s.specular = (lam_rgb){0, 0, 0};
        s.shininess = 0;
    }
    return s;
}

// Whether the shaders can express no difference between a scene and one of `scenes`: shaders without a name for a strength
// draw every term in every scene.
static bool is_repeated(const struct run *r, int index, unsigned scenes)
{
    const size_t from = offsetof(struct reference_scene, mesh);
    struct reference_scene mine = visible_scene(r, index);
    for (int i = 0; i < index; i++) {
        struct reference_scene other = visible_scene(r, i);
        if (scenes >> i & 1 && memcmp((char *)&mine + from, (char *)&other + from, sizeof mine - from) == 0)
            return true;
    }
    return false;
}

static bool choose_scenes(struct run *r, unsigned *scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    *scenes = 0;
    for (int i = 0; i < reference_scene_count; i++) {
        bool asked = p->scenes == NULL;
        for (int k = 0; p->scenes && k < p->scene_count; k++)
            asked |= strcmp(p->scenes[k], reference_scenes[i].name) == 0;
        if (asked && (reference_scenes[i].needs & ~r->interface.supports) == 0) {
            if (p->scenes || !is_repeated(r, i, *scenes))
                *scenes |= 1u << i;
        } else if (asked && p->scenes)
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
    if (p->contract)
        return &p->contract->contract;
    const struct contract *found = NULL;
    if (!contracts_read(r->shipped, &r->shipped_count, error) ||
        !contract_recognise(r->shipped, r->shipped_count, p->vertex, p->fragment, &found, error))
        return NULL;
    if (!found) {
        struct declarations d = {0};
        char uniforms[200] = "";
        if (p->vertex && declarations_read(&d, p->vertex, true, NULL))
            list_uniforms(&d, uniforms, sizeof uniforms);
        declarations_free(&d);
        if (declarations_read(&d, p->fragment, false, NULL))
            list_uniforms(&d, uniforms, sizeof uniforms);
        declarations_free(&d);
        fail(error, LAM_BAD_ARGUMENT,
             "no uniform or attribute of the shader has a name of a known contract (found %s); `lambent check --list` "
             "prints them, and --contract names another or a file",
             uniforms[0] ? uniforms : "none");
    }
    return found;
}

// Completes the shaders as the contract's engine does, and reads them.
static bool read_shaders(struct run *r, lam_error *error)
{
    const struct contract *contract = choose_contract(r, error);
    return contract && prefix_complete(contract, r->params->vertex, r->params->fragment, &r->texts, error) &&
           shader_interface_make(&r->interface, &r->texts, contract, error);
}

static bool is_printed(const struct run *r) { return r->interface.printed_model != LAM_REFLECTION_AUTO; }

static bool prepare(struct run *r, unsigned *scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    if (!p->fragment)
        return fail(error, LAM_BAD_ARGUMENT, "check: no fragment shader given");
    r->size = p->size ? p->size : 128;
    if (r->size < 32 || r->size > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "check: pictures of %d pixels, expected 32 to 1024", r->size);
    r->tolerance = p->tolerance > 0 ? p->tolerance : 2.0 / 255;
    if (!read_shaders(r, error))
        return false;
    const lam_reflection_info *printed = lam_reflection_describe(r->interface.printed_model);
    r->frame = p->light_frame == LAM_FRAME_WORLD ? r->interface.light_frame : p->light_frame;
    r->reflection = p->reflection != LAM_REFLECTION_AUTO            ? p->reflection
                    : r->interface.physical && !printed->microfacet ? LAM_REFLECTION_GGX
                    : is_printed(r)                                 ? r->interface.printed_model
                                                                    : r->interface.contract->reflection;
    if (r->interface.physical && p->reflection != LAM_REFLECTION_AUTO)
        return fail(error, LAM_BAD_ARGUMENT,
                    "check: the shader has metalness and roughness, whose highlight is not a matter of choice; leave "
                    "--highlight out");
    if (p->reflection != LAM_REFLECTION_AUTO && r->reflection != LAM_REFLECTION_PHONG &&
        r->reflection != LAM_REFLECTION_BLINN_PHONG)
        return fail(error, LAM_BAD_ARGUMENT, "check: unknown highlight, expected phong or blinn-phong");
    if (!p->vertex) {
        char unknown[256];
        r->vertex = default_vertex_shader(&r->interface, unknown, error);
        if (!r->vertex)
            return false;
        r->report->made_vertex = true;
        if (unknown[0])
            return fail(error, LAM_BAD_ARGUMENT,
                        "no vertex shader is given, and the contract %s does not say which values %s should have; give "
                        "the vertex shader with --vertex",
                        r->interface.contract->name, unknown);
    }
    return choose_scenes(r, scenes, error);
}

// --- drawing

static bool draw_here(struct run *r, const lam_bytes *request, lam_error *error)
{
    return check_draw(request->data, request->size, &r->painter, &r->bytes, error);
}

// False: no verdict is possible. A process that timed out or crashed sets the report's verdict.
static bool draw(struct run *r, unsigned scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    struct draw_request request = {.contract = r->interface.contract->text,
                                   .light_frame = p->light_frame,
                                   .size = r->size,
                                   .scenes = scenes,
                                   .vertex = r->texts.vertex ? r->texts.vertex : r->vertex,
                                   .fragment = r->texts.fragment};
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
        case LAM_CHECK_DRAW_MEMORY:
            r->report->verdict = LAM_CHECK_MEMORY;
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

// Whether the shaders' names are those of the contract: no verdict is honest where an input has no value. A contract that
// was asked for is kept, and so is a recognised one whose names are only misspelt: these are mistakes, which the report
// names.
static bool knows_inputs(struct run *r, lam_error *error)
{
    const struct shader_interface *interface = &r->interface;
    const struct draw_result *drawn = &r->drawn;
    const char *unknown[MAX_UNKNOWN_NAMES];
    int count = 0, misspelt = 0;
    if (r->params->contract || drawn->state != DRAWN_PICTURES)
        return true;
    for (int i = 0; i < drawn->unknown_count; i++) {
        unknown[count++] = drawn->unknown[i];
        misspelt += contract_is_misspelt(interface->contract, &interface->vertex, &interface->fragment, unknown[i]);
    }
    if (misspelt == count && !drawn->types_count)
        return true;
    char names[300] = "", types[160] = "";
    contract_describe_unknown(interface->contract, &interface->vertex, &interface->fragment, unknown, count, names,
                              sizeof names);
    if (drawn->types_count)
        snprintf(types, sizeof types, "%s%.120s", count ? "; " : "", drawn->types[0]);
    return fail(error, LAM_BAD_ARGUMENT,
                "the names are of no known contract; the nearest is %s, which has no %s%s; --contract %s checks by it, "
                "--contract FILE by your own",
                interface->contract->name, names, types, interface->contract->name);
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
    r.painter = params->painter ? *params->painter : gl_painter(params->gl_device);
    unsigned scenes = 0;
    bool ok = prepare(&r, &scenes, error);
    for (unsigned left = scenes; ok && left; left &= left - 1)
        report->scenes_wanted++;
    ok = ok && draw(&r, scenes, error) && knows_inputs(&r, error);
    if (ok) {
        report->contract = arena_string(r.arena, r.interface.contract->name);
        report->vertex_lit = r.interface.vertex_lit;
        diagnostics_add_names(&r.diagnostics, &r.drawn, &r.interface, params);
    }
    if (ok && report->verdict == LAM_CHECK_PASSES) {
        bool writes = compiler_hints_for_output(&r.diagnostics, &r.interface.fragment, params->fragment_name,
                                                r.interface.contract->outputs);
        ok = check_compare(&r, scenes, writes, error);
    }
    if (ok && r.diagnostics.failed)
        ok = fail_memory(error, 1);
    report->diagnostics = r.diagnostics.items;
    report->diagnostic_count = r.diagnostics.count;
    shader_interface_free(&r.interface);
    prefix_free(&r.texts);
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
    static const char *const names[] = {"passes",  "differs",      "refused",        "endless",
                                        "crashes", "not a number", "too much memory"};
    return verdict >= LAM_CHECK_PASSES && verdict <= LAM_CHECK_MEMORY ? names[verdict] : NULL;
}

const char *lam_check_scene_name(int index)
{
    return index >= 0 && index < reference_scene_count ? reference_scenes[index].name : NULL;
}

const char *lam_check_scene_description(int index)
{
    return index >= 0 && index < reference_scene_count ? reference_scenes[index].description : NULL;
}
