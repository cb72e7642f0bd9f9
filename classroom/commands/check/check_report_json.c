// check_report_json.c: prints the report of a check as JSON (docs/check.schema.json).
#include "check.h"

#include "exit_codes.h"
#include "json.h"

static const char *kind_name(lam_check_diagnostic_kind kind)
{
    return kind == LAM_CHECK_DIAGNOSTIC_COMPILER ? "compiler" : kind == LAM_CHECK_DIAGNOSTIC_HINT ? "hint" : "unknown";
}

static void put_points(struct json *json, const lam_check_report *r)
{
    static const char *const terms[] = {"ambient", "diffuse", "specular"};
    struct check_points points = check_points_of(r);
    json_open(json, "points", '{');
    json_number(json, "earned", points.earned);
    json_number(json, "possible", points.possible);
    for (int i = 0; i < 3; i++)
        if (points.terms[i] < 0)
            json_none(json, terms[i]);
        else
            json_number(json, terms[i], points.terms[i]);
    json_close(json, '}');
}

static void put_scenes(struct json *json, const lam_check_report *r)
{
    json_open(json, "scenes", '[');
    for (int i = 0; i < r->scene_count; i++) {
        const lam_check_scene *s = &r->scenes[i];
        json_open(json, NULL, '{');
        json_text(json, "name", s->name);
        json_text(json, "shows", s->description);
        json_count(json, "passes", s->passes);
        json_number(json, "maximum", s->maximum);
        json_number(json, "mean", s->mean);
        json_number(json, "share_over", s->share_over);
        json_count(json, "pixels", s->pixels);
        json_count(json, "not_numbers", s->not_numbers);
        json_text(json, "looks_like", s->looks_like);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void put_mistakes(struct json *json, const lam_check_report *r)
{
    json_open(json, "mistakes", '[');
    for (int i = 0; i < r->finding_count; i++) {
        const lam_check_finding *f = &r->findings[i];
        json_open(json, NULL, '{');
        json_text(json, "id", f->mistake);
        json_text(json, "says", f->explanation);
        json_text(json, "write", f->correction);
        json_count(json, "certain", f->certain);
        json_text(json, "also", f->also);
        json_number(json, "mean_before", f->mean_before);
        json_number(json, "mean_after", f->mean_after);
        json_number(json, "share", f->share);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void put_notes(struct json *json, const lam_check_report *r)
{
    json_open(json, "notes", '[');
    for (int i = 0; i < r->diagnostic_count; i++) {
        const lam_check_diagnostic *n = &r->diagnostics[i];
        json_open(json, NULL, '{');
        json_text(json, "kind", kind_name(n->kind));
        json_text(json, "file", n->file);
        json_count(json, "line", (uint64_t)n->line);
        json_text(json, "text", n->text);
        json_close(json, '}');
    }
    json_close(json, ']');
}

void check_report_json(FILE *file, const struct check_result *result, const char *name, double tolerance)
{
    const lam_check_report *r = &result->report;
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    if (name)
        json_text(&json, "submission", name);
    json_text(&json, "fragment", result->submission->fragment);
    json_text(&json, "vertex", result->submission->vertex);
    if (result->error.code) {
        json_text(&json, "error", result->error.text);
        json_count(&json, "exit_code", (uint64_t)result->code);
    } else {
        json_text(&json, "verdict", lam_check_verdict_name(r->verdict));
        json_text(&json, "contract", r->contract);
        json_text(&json, "lit_in", r->vertex_lit ? "vertex" : "fragment");
        json_text(&json, "driver", r->driver[0] ? r->driver : NULL);
        json_number(&json, "tolerance", tolerance);
        json_number(&json, "mean", r->mean);
        put_points(&json, r);
        put_scenes(&json, r);
        json_count(&json, "tried", r->tried);
        json_count(&json, "search_stopped", r->search_stopped);
        put_mistakes(&json, r);
        put_notes(&json, r);
        json_text(&json, "picture", result->sheet);
    }
    json_close(&json, '}');
    putc('\n', file);
}
