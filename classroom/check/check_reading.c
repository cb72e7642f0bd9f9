// check_reading.c: checks shaders whose inputs have no given roles, or whose strengths are free: finds a reading of the
// inputs, and reports the verdict that follows from it.
#include "check_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "fault.h"
#include "reading.h"

enum { MAX_STATED = 96 };
static const char *const space_names[] = {"world", "eye", "object"};

// The roles of readings, and the roles of contracts.
static const struct {
    enum reading_role role;
    bool opposite;
    enum uniform_semantic semantic;
} pairs[] = {{READ_MODEL, false, SEMANTIC_MODEL},
             {READ_VIEW, false, SEMANTIC_VIEW},
             {READ_PROJECTION, false, SEMANTIC_PROJECTION},
             {READ_MODEL_VIEW, false, SEMANTIC_MODEL_VIEW},
             {READ_VIEW_PROJECTION, false, SEMANTIC_VIEW_PROJECTION},
             {READ_ALL, false, SEMANTIC_MODEL_VIEW_PROJECTION},
             {READ_NORMAL_EYE, false, SEMANTIC_NORMAL_MATRIX},
             {READ_NORMAL_WORLD, false, SEMANTIC_NORMAL_MATRIX},
             {READ_LIGHT, false, SEMANTIC_LIGHT_POSITION},
             {READ_TO_LIGHT, false, SEMANTIC_LIGHT_DIRECTION},
             {READ_TO_LIGHT, true, SEMANTIC_LIGHT_TRAVEL},
             {READ_AXIS, false, SEMANTIC_LIGHT_TRAVEL},
             {READ_AXIS, true, SEMANTIC_LIGHT_DIRECTION},
             {READ_EYE, false, SEMANTIC_EYE_POSITION},
             {READ_POSITION, false, SEMANTIC_POSITION},
             {READ_NORMAL, false, SEMANTIC_NORMAL}};
enum { PAIRS = sizeof pairs / sizeof *pairs };

// Makes the roles that a contract or an engine states, written as "name=role" or "name=role/space".
static bool state_roles(struct run *r, const struct contract *contract, const struct contract *engine, const char **out)
{
    int count = 0;
    for (const char *const *s = r->params->roles; s && *s && count + 1 < MAX_STATED; s++)
        out[count++] = *s;
    // An engine fixes only the names that its prefix declares.
    const struct contract *from = contract ? contract : engine;
    for (const struct contract_name *n = from ? from->names : NULL; n && n->name; n++)
        for (int i = 0; i < PAIRS && count + 1 < MAX_STATED; i++) {
            char text[160];
            bool spaced = role_of(n->semantic)->uses & ROLE_IN_SPACE && n->semantic != SEMANTIC_NORMAL_MATRIX;
            int space = n->space == LAM_FRAME_WORLD ? 0 : n->space == LAM_FRAME_CAMERA ? 1 : 2;
            if (pairs[i].semantic != n->semantic || (!contract && !strstr(engine->prefix_vertex, n->name)) ||
                (n->semantic == SEMANTIC_NORMAL_MATRIX && (pairs[i].role == READ_NORMAL_WORLD) != (space == 0)))
                continue;
            snprintf(text, sizeof text, "%.90s=%s%s%s%s", n->name, pairs[i].opposite ? "-" : "",
                     reading_role_names[pairs[i].role], spaced ? "/" : "", spaced ? space_names[space] : "");
            out[count] = arena_string(r->arena, text);
            if (!out[count++])
                return false;
        }
    out[count] = NULL;
    return true;
}

// Makes the contract that describes a reading. The caller frees the text.
static char *contract_of(const struct reading *q, const struct declarations *sides, const struct contract *engine,
                         char *why, size_t capacity)
{
    struct inferred_role known[READ_LEAVES];
    int count = 0;
    const char *space = "world";
    for (int i = 0; i < q->leaf_count; i++) {
        const struct reading_leaf *leaf = &q->leaves[i];
        const struct reading_choice *c = &leaf->choices[leaf->chosen];
        for (int k = 0; k < PAIRS && c->role != READ_OTHER && leaf->node < 0; k++)
            if (pairs[k].role == c->role && pairs[k].opposite == (c->space >> 2)) {
                bool spaced = role_of(pairs[k].semantic)->uses & ROLE_IN_SPACE;
                const char *in = c->role == READ_NORMAL_EYE     ? "eye"
                                 : c->role == READ_NORMAL_WORLD ? "world"
                                                                : space_names[c->space & 3];
                known[count++] =
                    (struct inferred_role){leaf->name, role_of(pairs[k].semantic)->name, spaced ? in : NULL};
                space = c->role == READ_NORMAL_EYE || c->role == READ_MODEL_VIEW ? "eye" : space;
            }
    }
    return contract_infer(&sides[0], &sides[1], engine, known, count, q->form.vertex || !count ? "eye" : space, why,
                          capacity);
}

// The pictures of a right shader are its own references.
static void take_references(struct run *r, double *missing)
{
    const size_t pixels = (size_t)r->size * (size_t)r->size;
    *missing = 1;
    for (int s = 0; s < r->scene_count; s++) {
        size_t drawn = 0;
        for (size_t i = 0; i < pixels; i++) {
            const float *from = r->scenes[s].theirs + 4 * i;
            float *to = r->scenes[s].reference + 4 * i;
            bool clear = from[0] == 0 && from[1] == 0 && from[2] == 0 && from[3] == 0;
            memcpy(to, from, 3 * sizeof *to);
            to[3] = clear ? 0 : from[3] > 0 ? from[3] : 1;
            drawn += !clear;
        }
        r->scenes[s].reference_scene = shader_interface_scene(&r->interface, r->scenes[s].row);
        scene_comparison_find_inside(&r->scenes[s], r->size);
        if (drawn * 100 > pixels)
            *missing = 0;
    }
}

static void forget_pictures(struct run *r)
{
    for (int i = 0; i < r->report->scene_count; i++) {
        lam_image_free(&r->report->scenes[i].theirs);
        lam_image_free(&r->report->scenes[i].reference);
    }
    r->report->scene_count = r->scene_count = 0;
}

static void hint(struct run *r, const char *text)
{
    diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s", text);
}

static void report_form(struct run *r, const struct reading *q)
{
    char text[2000];
    reading_explain(q, text, sizeof text);
    if (text[0])
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "the check read the inputs as follows: %s",
                        text);
    if (q->one_way)
        diagnostics_add(
            &r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
            "the verdict holds if the uniforms of type bool are %s; with the other value, the colours are no sum "
            "of an ambient, a diffuse and a specular term",
            q->variant == 1 ? "false" : "true");
    if (q->form.general)
        hint(r, "the shader is no sum of an ambient, a diffuse and a specular term: the cosines of its vectors are "
                "right, but "
                "the check has not compared how the shader combines them");
    if (q->form.exponent > 0 && !q->form.gate)
        hint(r,
             "the highlight remains on surfaces that face away from the light (n.l <= 0); the check accepts this form");
    if (q->form.exponent >= 1)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "the exponent of the highlight is %g",
                        q->form.exponent);
    if (q->form.late_normal)
        hint(r, "the normal is normalized only in the fragment shader; the check accepts this form");
    if (r->params->explain_roles)
        for (int i = 0; i < q->leaf_count; i++) {
            const struct reading_leaf *leaf = &q->leaves[i];
            diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s (%s): %s%s, %s", leaf->name,
                            leaf->node >= 0   ? "numbers in the source"
                            : leaf->attribute ? "attribute"
                                              : "uniform",
                            leaf->choices[leaf->chosen].space & 4 ? "opposite " : "",
                            reading_role_names[leaf->choices[leaf->chosen].role],
                            leaf->attribute || leaf->type.columns > 1
                                ? "because gl_Position or the colours of a right shader need it"
                            : !leaf->geometric ? "because each component changes only its own channel"
                            : leaf->choice_count == 1
                                ? "because it is stated"
                                : "because the shader is right with this role, and the cheaper roles fail");
        }
}

// Explains which input contradicts its name. Returns false.
static bool fail_against(const struct reading *q, lam_error *error)
{
    for (int i = 0; i < q->leaf_count; i++)
        if (q->leaves[i].choices[q->leaves[i].chosen].against)
            return fail(
                error, LAM_BAD_ARGUMENT,
                "no verdict: is '%.60s' the eye or the light? The shader is right only if it is the %s, which its name "
                "does not say; state it: --role %.60s=%s",
                q->leaves[i].name, reading_role_names[q->leaves[i].choices[q->leaves[i].chosen].role],
                q->leaves[i].name, reading_role_names[q->leaves[i].choices[q->leaves[i].chosen].role]);
    return false;
}

bool check_read(struct run *r, const struct contract *contract, const struct contract *engine, struct reading **out,
                enum reading_outcome *outcome, char **text, lam_error *error)
{
    const struct declarations *sides = engine ? r->texts->sides : r->sources.own.sides;
    const char **stated = arena_array(r->arena, MAX_STATED, sizeof *stated);
    struct reading *q = arena_alloc_zeroed(r->arena, sizeof *q);
    char why[300] = "";
    if (!stated || !q || !state_roles(r, contract, engine, stated))
        return fail_memory(error, sizeof *q);
    q->arena = r->arena;
    q->stated = stated;
    *outcome = reading_find(q, &sides[0], &sides[1]);
    if (*outcome == READING_NONE && !q->reason[0] && q->nearest_count) {
        q->repair_count = repair_find(q);
        *outcome = q->repair_count ? READING_MISTAKEN : repair_accepts(q) ? READING_RIGHT : READING_NONE;
        if (*outcome == READING_NONE)
            reading_restore(q, &q->nearest[0]);
    }
    *out = q;
    if (text && !(*text = contract_of(q, sides, engine, why, sizeof why)))
        return fail_memory(error, 1);
    return true;
}

static const struct fault *row_of(const char *id)
{
    for (int i = 0; i < fault_count; i++)
        if (strcmp(faults[i].id, id) == 0)
            return &faults[i];
    return NULL;
}

static void report_repair(struct run *r, const struct repair *mistake, const char *const *also, int also_count,
                          double before, double whole)
{
    const struct fault *row = row_of(mistake->mistake);
    char text[400] = "", other[200] = "";
    lam_check_finding *out = &r->report->findings[r->report->finding_count++];
    for (int i = 0; i < also_count; i++)
        snprintf(other + strlen(other), sizeof other - strlen(other), "%s%s", i ? " " : "", also[i]);
    if (row)
        fault_text(row->explanation, &r->interface, r->frame, r->reflection, text, sizeof text);
    else // the only mistake that the search on drawn scenes does not know
        snprintf(text, sizeof text, "v is the difference of an eye and a point that are in different spaces");
    *out = (lam_check_finding){.mistake = mistake->mistake,
                               .explanation = arena_string(r->arena, text),
                               .also = also_count ? arena_string(r->arena, other) : NULL,
                               .certain = true,
                               .mean_before = before,
                               .mean_after = mistake->after,
                               .share = whole > 0 ? 1 - mistake->after / whole : 1};
    if (mistake->write[0])
        snprintf(text, sizeof text, "%.150s  // line %d, instead of %.150s", mistake->write, mistake->at,
                 mistake->line);
    else if (mistake->line[0])
        snprintf(text, sizeof text, "// line %d: mend %.200s", mistake->at, mistake->line);
    else if (row)
        fault_text(row->correction, &r->interface, r->frame, r->reflection, text, sizeof text);
    out->correction = arena_string(r->arena, text);
    if (mistake->at)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT,
                        mistake->side ? r->params->fragment_name : r->params->vertex_name, mistake->at, "%s: %.200s",
                        mistake->mistake, mistake->line);
}

// Draws the mended shaders as references. Returns false on error; *drawn is false if the repair has no text.
static bool draw_mended(struct run *r, const struct declarations *sides, const struct repair *repairs, int count,
                        unsigned scenes, bool *drawn, lam_error *error)
{
    const struct complete_texts *own = r->texts;
    const size_t pixels = (size_t)r->size * (size_t)r->size * 4;
    char *mended[2] = {repair_text(&sides[0], repairs, count, 0), repair_text(&sides[1], repairs, count, 1)};
    struct complete_texts texts = *own;
    bool ok = (mended[0] && mended[1]) || fail_memory(error, 1);
    *drawn = true;
    for (int i = 0; i < count; i++)
        *drawn = *drawn && repairs[i].text[0];
    if (ok && *drawn) {
        texts.vertex = mended[0];
        texts.fragment = mended[1];
        r->texts = &texts;
        ok = r->draw_again(r, scenes, error);
        r->texts = own;
        *drawn = ok && r->drawn.state == DRAWN_PICTURES;
        for (int s = 0; *drawn && s < r->scene_count; s++) {
            memcpy(r->scenes[s].reference, r->drawn.pixels + (size_t)s * pixels, pixels * sizeof(float));
            r->scenes[s].reference_scene = shader_interface_scene(&r->interface, r->scenes[s].row);
            for (size_t i = 0; i < pixels; i += 4) {
                float *p = r->scenes[s].reference + i;
                p[3] = p[0] == 0 && p[1] == 0 && p[2] == 0 && p[3] == 0 ? 0 : p[3] > 0 ? p[3] : 1;
            }
            scene_comparison_find_inside(&r->scenes[s], r->size);
        }
    }
    free(mended[0]);
    free(mended[1]);
    return ok;
}

// Reports the mistakes of a shader that is right after repairs.
static bool report_mistakes(struct run *r, struct reading *q, unsigned scenes, lam_error *error)
{
    const struct declarations both[] = {*q->sides[0].text, *q->sides[1].text};
    const int count = q->repair_count;
    bool drawn = false;
    if ((r->report->scene_count == 0 && !check_make_scenes(r, scenes, error)) ||
        !draw_mended(r, both, q->repairs, count, scenes, &drawn, error))
        return false;
    if (drawn && !q->rows)
        check_measure(r);
    else
        forget_pictures(r); // row vectors are not drawn
    r->report->verdict = LAM_CHECK_DIFFERS;
    r->report->findings = arena_alloc_zeroed(r->arena, MAX_REPAIR_STEPS * sizeof *r->report->findings);
    for (int i = 0; r->report->findings && i < count; i++) {
        bool again = false; // the same mistake in another line
        for (int k = 0; k < count; k++)
            again = again || (k < i && strcmp(q->repairs[k].mistake, q->repairs[i].mistake) == 0) ||
                    (strcmp(q->repairs[i].mistake, "normal-not-unit") == 0 &&
                     strcmp(q->repairs[k].mistake, "normal-never-unit") == 0);
        if (!again)
            report_repair(r, &q->repairs[i], q->also, i ? 0 : q->also_count, i ? q->repairs[i - 1].after : q->mean,
                          q->mean);
    }
    return r->report->findings || fail_memory(error, 1);
}

// Reports a form that a stated contract forbids. Returns false on error; *fails is false if there is none.
static bool report_demand(struct run *r, const struct reading *q, const struct contract *contract, bool *fails,
                          lam_error *error)
{
    const bool no_gate = contract->demands & DEMAND_GATE && q->form.exponent > 0 && !q->form.gate,
               late = contract->demands & DEMAND_UNIT_NORMALS && q->form.late_normal;
    const struct repair form = {.mistake = no_gate ? "no-gate" : "normal-unit-late"};
    *fails = no_gate || late;
    r->report->findings = *fails ? arena_alloc_zeroed(r->arena, sizeof *r->report->findings) : NULL;
    if (r->report->findings)
        report_repair(r, &form, NULL, 0, r->report->mean, r->report->mean);
    return r->report->findings || !*fails || fail_memory(error, 1);
}

bool check_conclude(struct run *r, struct reading *q, enum reading_outcome outcome, unsigned scenes, lam_error *error)
{
    double missing;
    if (outcome == READING_AGAINST)
        return fail_against(q, error);
    if (outcome == READING_MISTAKEN)
        return report_mistakes(r, q, scenes, error);
    if (outcome == READING_NONE)
        return fail(
            error, LAM_BAD_ARGUMENT, "no verdict: %s%s",
            q->reason[0] ? q->reason
            : q->spent   ? "time: the check tried as many roles of the inputs as it may"
                       : "the check cannot explain the colours as the sum of an ambient, a diffuse and a specular term",
            q->reason[0] ? ""
                         : "; --role NAME=ROLE states the role of an input, --contract FILE the roles of all inputs "
                           "(docs/check/contract-file.md)");
    if (r->report->scene_count == 0 && !check_make_scenes(r, scenes, error))
        return false;
    take_references(r, &missing);
    if (missing > 0.5 && q->rows) {
        hint(r, "the scenes are not drawn, because the shader multiplies row vectors by matrices; the verdict follows "
                "from its evaluation");
        forget_pictures(r);
        r->report->scenes_wanted = 0;
        r->report->verdict = LAM_CHECK_PASSES;
        report_form(r, q);
        return true;
    }
    if (missing > 0.5)
        return fail(error, LAM_BAD_ARGUMENT, "no verdict: the model is not drawn; an input was probably misread");
    check_measure(r);
    hint(r, "the verdict follows from an evaluation of the source; the reference of the scenes is the shader's own "
            "picture");
    report_form(r, q);
    return true;
}

bool check_doubt(struct run *r, const struct contract *contract, unsigned scenes, lam_error *error)
{
    lam_check_report *report = r->report;
    struct reading *q;
    enum reading_outcome outcome;
    const bool stated = r->params->contract, strict = stated && !contract->constants[0].name;
    double clear = 1;
    for (int i = 0; i < r->scene_count; i++) {
        double share = check_missing_share(&r->scenes[i], false);
        clear = share < clear ? share : clear;
    }
    if (r->interface.physical || !r->writes_colour || (report->finding_count && (stated || !r->drawn.unknown_count)))
        return true;
    if (!check_read(r, stated ? contract : NULL, contract->prefix_fragment ? contract : NULL, &q, &outcome, NULL,
                    error))
        return false;
    if ((strict && outcome == READING_RIGHT) || (stated && outcome == READING_NONE) ||
        (clear > 0.9 && !(outcome != READING_NONE && q->rows)))
        return true;
    bool named = false;
    if (stated && outcome == READING_RIGHT && (!report_demand(r, q, contract, &named, error) || named))
        return named;
    for (int i = 0; i < report->scene_count; i++)
        report->scenes[i].looks_like = NULL;
    report->finding_count = 0;
    r->diagnostics.count = 0;
    report->tried = 0;
    report->search_stopped = false;
    diagnostics_add_names(&r->diagnostics, &r->drawn, &r->interface, r->params);
    return check_conclude(r, q, outcome, scenes, error);
}
