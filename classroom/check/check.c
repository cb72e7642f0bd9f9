// check.c: runs a check: parses the shaders, draws the scenes, and compares the pictures.
#include "check_run.h"
#include "draw_request.h"
#include "diagnostics.h"
#include "prefix.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "spelling.h"

// --- preparation

// Returns a scene without the features that the shaders cannot express, and without the features that no term of the
// scene shows.
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

// Returns whether, for these shaders, a scene is identical to one of the earlier scenes in `scenes`. Shaders that
// declare no name for a strength draw every term in every scene.
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

// Gets the given contract or, if no contract is given, the contract that contains the shaders' names. `*out` is NULL if
// there is no such contract. On failure, returns false and sets `error`.
static bool choose_contract(struct run *r, const struct contract **out, lam_error *error)
{
    const lam_check_params *p = r->params;
    *out = p->contract ? &p->contract->contract : NULL;
    return p->contract || (contracts_read(r->shipped, &r->shipped_count, error) &&
                           contract_recognise(r->shipped, r->shipped_count, &r->sources, out, error));
}

// Makes the interface of the shaders with the lines that the contract's engine adds.
static bool read_shaders(struct run *r, const struct contract *contract, lam_error *error)
{
    r->texts = prefix_texts(&r->sources, contract, error);
    return r->texts && shader_interface_make(&r->interface, r->texts, contract, error);
}

static bool is_printed(const struct run *r) { return r->interface.printed_model != LAM_REFLECTION_AUTO; }

static bool check_params(struct run *r, lam_error *error)
{
    const lam_check_params *p = r->params;
    if (!p->fragment)
        return fail(error, LAM_BAD_ARGUMENT, "check: no fragment shader given");
    r->size = p->size ? p->size : 128;
    if (r->size < 32 || r->size > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "check: pictures of %d pixels, expected 32 to 1024", r->size);
    r->tolerance = p->tolerance > 0 ? p->tolerance : 2.0 / 255;
    return true;
}

static bool prepare(struct run *r, const struct contract *contract, unsigned *scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    if (!read_shaders(r, contract, error))
        return false;
    const lam_reflection_info *printed = lam_reflection_describe(r->interface.printed_model);
    r->frame = p->light_frame == LAM_FRAME_WORLD ? r->interface.light_frame : p->light_frame;
    r->reflection = p->reflection != LAM_REFLECTION_AUTO            ? p->reflection
                    : r->interface.physical && !printed->microfacet ? LAM_REFLECTION_GGX
                    : is_printed(r)                                 ? r->interface.printed_model
                                                                    : r->interface.contract->reflection;
    if (r->interface.physical && p->reflection != LAM_REFLECTION_AUTO)
        return fail(error, LAM_BAD_ARGUMENT,
                    "check: the shader has metalness and roughness, which determine its highlight; omit --highlight");
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
                        "no vertex shader is given, and the contract %s does not define values for %s; name the vertex "
                        "shader with --vertex",
                        r->interface.contract->name, unknown);
    }
    return choose_scenes(r, scenes, error);
}

// --- drawing

bool check_read_texts(void *user, struct complete_texts *texts, lam_error *error)
{
    const lam_check_params *p = user;
    if (!p->draw)
        return prefix_read(NULL, texts, error);
    struct draw_request request = {.contract = "",
                                   .vertex = texts->vertex ? texts->vertex : "",
                                   .fragment = texts->fragment,
                                   .size = READ_ONLY,
                                   .lines = {texts->lines[0], texts->lines[1]}};
    lam_bytes bytes = {0}, answer = {0};
    if (!draw_request_write(&request, &bytes, error))
        return false;
    lam_check_draw_status status = p->draw(p->user, &bytes, &answer, error);
    const char *at = answer.data, *end = at + answer.size;
    bool ok = status == LAM_CHECK_DRAW_DONE && declarations_unpack(&texts->sides[0], &at, end) &&
              declarations_unpack(&texts->sides[1], &at, end);
    if (!ok && status != LAM_CHECK_DRAW_FAILED)
        fail(error, LAM_LIMIT, "no verdict: the process that reads the shaders %s",
             status == LAM_CHECK_DRAW_TIMEOUT  ? "exceeded its time limit"
             : status == LAM_CHECK_DRAW_MEMORY ? "exceeded its memory limit"
                                               : "crashed");
    lam_bytes_free(&bytes);
    lam_bytes_free(&answer);
    return ok;
}

// Explains that there is no verdict because a part of the shaders was not read. Returns false.
static bool fail_cut(const struct run *r, lam_error *error)
{
    return fail(error, LAM_LIMIT,
                "no verdict: the %s shader is too long to check; expected at most %d words after its macros are "
                "expanded, and at most %d declared names",
                r->sources.own.sides[0].cut ? "vertex" : "fragment", MAX_WORDS, MAX_DECLARATIONS);
}

static bool is_cut(const struct run *r) { return r->sources.own.sides[0].cut || r->sources.own.sides[1].cut; }

static bool draw_here(struct run *r, const lam_bytes *request, lam_error *error)
{
    return check_draw(request->data, request->size, &r->painter, &r->bytes, error);
}

// Draws the scenes. Returns false if no verdict is possible. Sets the report's verdict if the drawing process timed out
// or crashed.
static bool draw(struct run *r, unsigned scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    struct draw_request request = {.contract = r->interface.contract->text,
                                   .light_frame = p->light_frame,
                                   .size = r->size,
                                   .scenes = scenes,
                                   .vertex = r->texts->vertex ? r->texts->vertex : r->vertex,
                                   .fragment = r->texts->fragment};
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
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "scene '%.30s' took %.2g s of processor time, but a correct shader takes milliseconds: is "
                        "there an endless loop? Some drivers leave it after many iterations, others hang",
                        r->drawn.log, r->drawn.seconds);
    } else if (r->drawn.state != DRAWN_PICTURES) {
        r->report->verdict = LAM_CHECK_REFUSED;
        diagnostics_add_refusal(&r->diagnostics, &r->drawn, &r->interface, p);
    } else if (is_cut(r)) {
        return fail_cut(r, error);
    }
    return true;
}

static bool draw_again(struct run *r, unsigned scenes, lam_error *error)
{
    const lam_check_verdict verdict = r->report->verdict;
    const int said = r->diagnostics.count;
    for (int i = 0; i < r->scene_count; i++)
        r->scenes[i].theirs = r->report->scenes[i].theirs.pixels;
    lam_bytes_free(&r->bytes);
    r->drawn = (struct draw_result){0};
    r->report->verdict = LAM_CHECK_PASSES;
    bool ok = draw(r, scenes, error);
    r->report->verdict = verdict;
    r->diagnostics.count = said;
    return ok;
}

#define BIT(semantic) ((uint64_t)1 << (semantic))
// The roles of names that do not concern lighting.
static const uint64_t matrices_and_zero = BIT(SEMANTIC_MODEL_VIEW) | BIT(SEMANTIC_PROJECTION) |
                                          BIT(SEMANTIC_MODEL_VIEW_PROJECTION) | BIT(SEMANTIC_NORMAL_MATRIX) |
                                          BIT(SEMANTIC_MODEL) | BIT(SEMANTIC_VIEW) | BIT(SEMANTIC_VIEW_PROJECTION) |
                                          BIT(SEMANTIC_ZERO) | BIT(SEMANTIC_ONE) | BIT(SEMANTIC_EYE_POSITION);

// Returns whether a name is probably a misspelt name of the contract.
static bool is_misspelt(const struct contract *contract, const char *name)
{
    const char *near = contract_nearest(contract, name);
    return near && lam_word_distance(name, near) > 0;
}

// Returns whether the shaders use the names of the contract. A verdict needs a value for every input. Misspelt names
// are mistakes, which the report lists. Names that differ from the contract's names only in case and underscores belong
// to another course.
static bool suits_contract(const struct run *r)
{
    bool drawn_here = !r->texts->vertex;
    for (const char *const *word = r->interface.contract->built_ins; *word; word++)
        drawn_here = drawn_here || declarations_uses(&r->interface.vertex, *word);
    for (int i = 0; i < r->interface.vertex.count; i++) {
        const struct declaration *item = &r->interface.vertex.items[i];
        const struct contract_name *n =
            item->kind == DECLARED_INPUT ? contract_find(r->interface.contract, item->name, true, NULL) : NULL;
        drawn_here = drawn_here || (n && n->semantic == SEMANTIC_POSITION);
    }
    const struct shader_interface *interface = &r->interface;
    const struct draw_result *drawn = &r->drawn;
    int misspelt = 0;
    if (drawn->state != DRAWN_PICTURES)
        return true;
    for (int i = 0; i < drawn->unknown_count; i++)
        misspelt += is_misspelt(interface->contract, drawn->unknown[i]);
    bool lit = r->params->contract || !r->texts->vertex ||
               ((interface->declared | interface->constants) & ~matrices_and_zero) != 0 ||
               interface->defaults.has_direction;
    return misspelt == drawn->unknown_count && !drawn->types_count && lit && drawn_here;
}

// Explains why the nearest contract does not fit. Returns false.
static bool fail_unknown(struct run *r, const char *reason, lam_error *error)
{
    const struct shader_interface *interface = &r->interface;
    char names[300] = "", types[160] = "";
    size_t at = 0;
    for (int i = 0; interface->contract && i < r->drawn.unknown_count && at + 120 < sizeof names; i++) {
        const char *near = contract_nearest(interface->contract, r->drawn.unknown[i]);
        at += (size_t)snprintf(names + at, sizeof names - at, "%s'%.40s'%s%.40s%s", i ? ", " : "", r->drawn.unknown[i],
                               near ? " (there: " : "", near ? near : "", near ? ")" : "");
    }
    if (r->drawn.types_count)
        snprintf(types, sizeof types, "%s%.120s", names[0] ? "; " : "", r->drawn.types[0]);
    const char *nearest = interface->contract && (names[0] || types[0]) ? interface->contract->name : NULL;
    return fail(
        error, LAM_BAD_ARGUMENT,
        "no verdict: %s%s%s%s%s%s%s; --contract FILE states the role of each input (docs/check/contract-file.md)",
        reason, nearest ? "; the contract " : "", nearest ? nearest : "", nearest ? " has no " : "", names, types, "");
}

static void forget_scenes(struct run *r)
{
    for (int i = 0; i < r->report->scene_count; i++) {
        lam_image_free(&r->report->scenes[i].theirs);
        lam_image_free(&r->report->scenes[i].reference);
    }
    r->report->scene_count = r->scene_count = 0;
    r->report->finding_count = 0;
    r->report->verdict = LAM_CHECK_PASSES;
    lam_bytes_free(&r->bytes);
    r->drawn = (struct draw_result){0};
}

// Finds the errors of a fragment shader that fits no contract and has no vertex shader. Sets the verdict if the shader
// does not compile.
static bool compile_alone(struct run *r, lam_error *error)
{
    static const char vertex[] = "#version 330\nvoid main() { gl_Position = vec4(0.0); }\n";
    free(r->vertex);
    r->vertex = strdup(vertex);
    if (!r->vertex)
        return fail_memory(error, sizeof vertex);
    if (!read_shaders(r, &r->shipped[0]->contract, error) || !draw(r, 1, error))
        return false;
    if (r->drawn.state == DRAWN_REFUSED && r->drawn.refused_fragment)
        return true;
    r->diagnostics.count = 0; // removes the errors of linking with an empty vertex shader
    forget_scenes(r);
    return true;
}

// Finds a reading of the inputs, draws with the contract that describes it, and gives the verdict.
static bool run_inferred(struct run *r, const struct contract *nearest, lam_error *error)
{
    const struct contract *engine = nearest && r->texts->owned[1] ? nearest : NULL;
    if (!r->params->vertex) {
        if (!nearest && !compile_alone(r, error))
            return false;
        return r->report->verdict != LAM_CHECK_PASSES ||
               fail_unknown(r,
                            "the names match no known contract, and without a vertex shader, the roles of the inputs "
                            "are unknown",
                            error);
    }
    struct reading *reading;
    enum reading_outcome outcome;
    char *text = NULL;
    unsigned scenes = 0;
    if (!check_read(r, NULL, engine, &reading, &outcome, &text, error))
        return false;
    r->inferred = lam_check_contract_read(text, strlen(text), "inferred contract", error);
    free(text);
    forget_scenes(r);
    if (!r->inferred && reading->reason[0])
        return fail(error, LAM_BAD_ARGUMENT, "no verdict: %s", reading->reason);
    if (!r->inferred || !prepare(r, &r->inferred->contract, &scenes, error) || !draw(r, scenes, error))
        return false;
    r->report->scenes_wanted = __builtin_popcount(scenes);
    return r->report->verdict != LAM_CHECK_PASSES || check_conclude(r, reading, outcome, scenes, error);
}

// Returns whether most names are not in the contract, which is a guess.
static bool is_far_guess(const struct run *r)
{
    const struct declarations *sides[] = {&r->interface.vertex, &r->interface.fragment};
    int unknown = 0, known = 0;
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++)
            if (sides[s]->items[i].kind == DECLARED_UNIFORM)
                *(contract_find(r->interface.contract, sides[s]->items[i].name, false, NULL) ? &known : &unknown) += 1;
    return !r->params->contract && unknown > known;
}

// Compares the shaders with the requested contract, or with the contract whose names the shaders use.
static bool run_contract(struct run *r, const struct contract *contract, unsigned scenes, lam_error *error)
{
    const lam_check_params *p = r->params;
    for (int i = 0; i < r->drawn.unknown_count && r->drawn.state == DRAWN_PICTURES; i++)
        if (!is_misspelt(contract, r->drawn.unknown[i]))
            return fail_unknown(r, "an input has no value", error);
    if (!is_far_guess(r))
        diagnostics_add_names(&r->diagnostics, &r->drawn, &r->interface, p);
    r->report->scenes_wanted = __builtin_popcount(scenes);
    if (r->report->verdict != LAM_CHECK_PASSES)
        return true;
    r->writes_colour =
        compiler_hints_for_output(&r->diagnostics, &r->interface.fragment, p->fragment_name, contract->outputs);
    if (!contract->any_strengths)
        return check_compare(r, scenes, error);
    struct reading *reading;
    enum reading_outcome outcome;
    return check_read(r, contract, contract->prefix_fragment ? contract : NULL, &reading, &outcome, NULL, error) &&
           check_conclude(r, reading, outcome, scenes, error);
}

bool lam_check_run(const lam_check_params *params, lam_check_report *report, lam_error *error)
{
    *report = (lam_check_report){0};
    if (!check_reserved("lam_check_params", params, error) ||
        (params->painter && !check_reserved("lam_check_painter", params->painter, error)))
        return false;
    // A copy of the parameters. In the copied shaders, inputs replace the fixed-function state of GLSL 110 and 120.
    lam_check_params own = *params;
    struct run r = {.params = &own, .report = report, .draw_again = draw_again, .writes_colour = true};
    r.arena = report->memory = calloc(1, sizeof *r.arena);
    if (!r.arena)
        return fail_memory(error, sizeof *r.arena);
    arena_start(r.arena, NULL);
    r.diagnostics.arena = r.arena;
    r.painter = params->painter ? *params->painter : gl_painter(params->gl_device);
    unsigned scenes = 0;
    const struct contract *contract = NULL;
    struct own_texts texts;
    bool readable = own_texts_make(params->vertex, params->fragment, &texts, error);
    own.vertex = texts.vertex;
    own.fragment = texts.fragment;
    r.sources = (struct program_texts){
        .own = {.vertex = own.vertex, .fragment = own.fragment}, .read = check_read_texts, .user = &own};
    bool ok = readable && check_params(&r, error) && check_read_texts(&own, &r.sources.own, error) &&
              choose_contract(&r, &contract, error);
    if (ok && contract)
        ok = prepare(&r, contract, &scenes, error) && draw(&r, scenes, error);
    if (ok && contract && (params->contract || suits_contract(&r)))
        ok = run_contract(&r, contract, scenes, error) && (contract->printed || report->verdict != LAM_CHECK_DIFFERS ||
                                                           !params->vertex || check_doubt(&r, contract, scenes, error));
    else
        ok = ok && run_inferred(&r, contract, error);
    if (!ok && is_cut(&r))
        fail_cut(&r, error); // this is the cause of any other error
    for (int s = 0; ok && s < 2 && report->verdict <= LAM_CHECK_REFUSED; s++)
        compiler_hints_for_unused(&r.diagnostics, &r.sources.own.sides[s], s ? own.fragment_name : own.vertex_name);
    if (ok) {
        report->contract = arena_string(r.arena, r.interface.contract->name);
        report->contract_text = arena_string(r.arena, r.interface.contract->text);
        for (int i = 0; i < report->scene_count; i++)
            report->scenes[i].weight = r.interface.contract->weights[reference_scene_find(report->scenes[i].name)];
        report->vertex_lit = r.interface.vertex_lit;
    }
    if (ok && r.diagnostics.failed)
        ok = fail_memory(error, 1);
    report->diagnostics = r.diagnostics.items;
    report->diagnostic_count = r.diagnostics.count;
    prefix_free(&r.sources.own);
    prefix_free(&r.sources.completed);
    for (int i = 0; i < r.shipped_count; i++)
        lam_check_contract_free(r.shipped[i]);
    lam_check_contract_free(r.inferred);
    free(r.vertex);
    lam_bytes_free(&r.bytes);
    own_texts_free(&texts);
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
