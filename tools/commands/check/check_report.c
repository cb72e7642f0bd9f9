// check_report.c: prints the report of a check, as text and as JSON (docs/check.schema.json).
#include "check.h"

#include <string.h>

#include "exit_codes.h"
#include "json.h"

static const char *kind_name(lam_check_diagnostic_kind kind)
{
    return kind == LAM_CHECK_DIAGNOSTIC_COMPILER ? "compiler" : kind == LAM_CHECK_DIAGNOSTIC_HINT ? "hint" : "unknown";
}

static void print_diagnostics(FILE *file, const lam_check_report *r)
{
    for (int i = 0; i < r->diagnostic_count; i++) {
        const lam_check_diagnostic *n = &r->diagnostics[i];
        fputs("  ", file);
        if (n->file)
            fprintf(file, "%s:", n->file);
        if (n->line)
            fprintf(file, "%d:", n->line);
        fprintf(file, "%s%s%s\n", n->file || n->line ? " " : "", n->kind == LAM_CHECK_DIAGNOSTIC_HINT ? "hint: " : "",
                n->text);
    }
}

static void print_scenes(FILE *file, const lam_check_report *r, double tolerance)
{
    if (!r->scene_count)
        return;
    fprintf(file, "  scene         largest     mean  over %g/255\n", tolerance);
    for (int i = 0; i < r->scene_count; i++) {
        const lam_check_scene *s = &r->scenes[i];
        fprintf(file, "  %-12s %8.4f %8.5f %8.2f %%   %s%s%s", s->name, s->maximum, s->mean, s->share_over * 100,
                s->passes ? "same" : "differs", s->looks_like ? ", looks like " : "",
                s->looks_like ? s->looks_like : "");
        if (s->not_numbers)
            fprintf(file, ", %llu pixels are NaN or infinite", (unsigned long long)s->not_numbers);
        putc('\n', file);
    }
}

void check_print_no_finding(FILE *file, const lam_check_report *r)
{
    unsigned long long tried = (unsigned long long)r->tried;
    if (r->search_stopped)
        fprintf(file,
                "No explanation among %llu mistakes and sets of them; there the search ended, and --search-limit sets "
                "its limit.",
                tried);
    else if (tried)
        fprintf(file, "No known mistake explains it, of %llu mistakes and sets of them that were tried.", tried);
    else
        fputs("No known mistake explains it.", file);
}

static void print_findings(FILE *file, const lam_check_report *r)
{
    if (!r->finding_count) {
        if (r->verdict == LAM_CHECK_DIFFERS) {
            check_print_no_finding(file, r);
            putc('\n', file);
        }
        return;
    }
    const char *these = r->finding_count > 1 ? " these together" : " this";
    if (r->findings[0].certain)
        fprintf(file, "It looks like%s:\n", these);
    else
        fprintf(file, "It looks most like%s, which explains %.0f %% of the difference; there is more:\n", these,
                r->findings[r->finding_count - 1].share * 100);
    for (int i = 0; i < r->finding_count; i++) {
        const lam_check_finding *f = &r->findings[i];
        fprintf(file, "  %s: %s\n    mean difference %.5f without it, %.5f with it\n    write  %s\n", f->mistake,
                f->explanation, f->mean_before, f->mean_after, f->correction);
        if (f->also)
            fprintf(file, "    the same pictures as  %s\n", f->also);
    }
}

void check_report_text(FILE *file, const lam_check_report *r, const char *shader, double tolerance)
{
    fprintf(file, "%s %s\n", shader, check_verdict_text(r->verdict));
    fprintf(file, "  contract %s; lit in the %s shader%s%s%s\n", r->contract, r->vertex_lit ? "vertex" : "fragment",
            r->made_vertex ? "; the vertex shader was generated" : "", r->driver[0] ? "; " : "", r->driver);
    print_diagnostics(file, r);
    print_scenes(file, r, tolerance);
    print_findings(file, r);
}

void check_report_line(FILE *file, const struct check_result *result)
{
    const lam_check_report *r = &result->report;
    if (result->error.code) {
        fprintf(file, "%-32s no verdict\n", result->submission->name);
        return;
    }
    struct check_points points = check_points_of(r);
    fprintf(file, "%-32s %-12s %2d of %2d", result->submission->name, lam_check_verdict_name(r->verdict), points.earned,
            points.possible);
    for (int i = 0; i < r->finding_count; i++)
        fprintf(file, "%s%s", i ? ", " : "  ", r->findings[i].mistake);
    if (r->finding_count && !r->findings[0].certain)
        fprintf(file, " (%.0f %% of the difference)", r->findings[r->finding_count - 1].share * 100);
    putc('\n', file);
}

static void put_points(struct json *json, const lam_check_report *r)
{
    static const char *const terms[] = {"ambient", "diffuse", "specular"};
    struct check_points points = check_points_of(r);
    json_open(json, "points", '{');
    json_count(json, "earned", (uint64_t)points.earned);
    json_count(json, "possible", (uint64_t)points.possible);
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

static void print_contract(FILE *file, const lam_check_contract *contract)
{
    lam_check_name row;
    fprintf(file, "contract %s: %s\n", lam_check_contract_name(contract), lam_check_contract_title(contract));
    for (int i = 0; lam_check_contract_row(contract, i, &row); i++)
        fprintf(file, "  %-9s %-9s %-28s %s%s%s%s%s\n", row.attribute ? "attribute" : "uniform", row.type, row.name,
                row.meaning, row.space ? "; space: " : "", row.space ? row.space : "", row.synonyms ? "; also " : "",
                row.synonyms ? row.synonyms : "");
}

bool check_print_lists(FILE *file, lam_error *error)
{
    for (int i = 0; lam_check_contract_shipped(i); i++) {
        const char *name = lam_check_contract_shipped(i), *text = lam_check_contract_text(name);
        lam_check_contract *contract = lam_check_contract_read(text, strlen(text), name, error);
        if (!contract)
            return false;
        print_contract(file, contract);
        lam_check_contract_free(contract);
    }
    fputs("scenes\n", file);
    for (int i = 0; lam_check_scene_name(i); i++)
        fprintf(file, "  %-12s %s\n", lam_check_scene_name(i), lam_check_scene_description(i));
    fputs("mistakes\n", file);
    for (int i = 0; lam_check_mistake(i); i++)
        fprintf(file, "  %-26s %s\n", lam_check_mistake(i), lam_check_mistake_explanation(i));
    return true;
}
