// check_report_json.c: prints the report of a check as JSON (docs/check.schema.json).
#include "check.h"

#include "console.h"
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
    json_put(json, NUMBER("earned", points.earned), NUMBER("possible", points.possible));
    for (int i = 0; i < 3; i++)
        if (points.terms[i] < 0)
            json_put(json, NONE(terms[i]));
        else
            json_number(json, terms[i], points.terms[i]);
    json_close(json, '}');
}

static void put_scenes(struct json *json, const lam_check_report *r)
{
    json_open(json, "scenes", '[');
    for (int i = 0; i < r->scene_count; i++) {
        const lam_check_scene *s = &r->scenes[i];
        json_put(json, OBJECT(NULL, TEXT("name", s->name), TEXT("shows", s->description), COUNT("passes", s->passes),
                              NUMBER("maximum", s->maximum), NUMBER("mean", s->mean),
                              NUMBER("share_over", s->share_over), COUNT("pixels", s->pixels),
                              COUNT("not_numbers", s->not_numbers), TEXT("looks_like", s->looks_like)));
    }
    json_close(json, ']');
}

static void put_mistakes(struct json *json, const lam_check_report *r)
{
    json_open(json, "mistakes", '[');
    for (int i = 0; i < r->finding_count; i++) {
        const lam_check_finding *f = &r->findings[i];
        json_put(json,
                 OBJECT(NULL, TEXT("id", f->mistake), TEXT("says", f->explanation), TEXT("write", f->correction),
                        COUNT("certain", f->certain), TEXT("also", f->also), NUMBER("mean_before", f->mean_before),
                        NUMBER("mean_after", f->mean_after), NUMBER("share", f->share)));
    }
    json_close(json, ']');
}

static void put_notes(struct json *json, const lam_check_report *r)
{
    json_open(json, "notes", '[');
    for (int i = 0; i < r->diagnostic_count; i++) {
        const lam_check_diagnostic *n = &r->diagnostics[i];
        json_put(json, OBJECT(NULL, TEXT("kind", kind_name(n->kind)), TEXT("file", n->file), COUNT("line", n->line),
                              TEXT("text", n->text)));
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
    json_put(&json, TEXT("fragment", result->submission->fragment), TEXT("vertex", result->submission->vertex));
    if (result->error.code) {
        json_put(&json, TEXT("error", result->error.text), COUNT("exit_code", result->code));
    } else {
        json_put(&json, TEXT("verdict", lam_check_verdict_name(r->verdict)), TEXT("contract", r->contract),
                 TEXT("lit_in", r->vertex_lit ? "vertex" : "fragment"), TEXT("driver", r->driver[0] ? r->driver : NULL),
                 NUMBER("tolerance", tolerance), NUMBER("mean", r->mean));
        put_points(&json, r);
        put_scenes(&json, r);
        json_put(&json, COUNT("tried", r->tried), COUNT("search_stopped", r->search_stopped));
        put_mistakes(&json, r);
        put_notes(&json, r);
        json_text(&json, "picture", result->sheet);
    }
    json_close(&json, '}');
    putc('\n', file);
}
