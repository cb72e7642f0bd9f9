// check_report.c: prints the report of a check as text.
#include "check.h"

#include <string.h>

#include "foreign.h"

static void print_diagnostics(FILE *file, const lam_check_report *r)
{
    for (int i = 0; i < r->diagnostic_count; i++) {
        const lam_check_diagnostic *n = &r->diagnostics[i];
        fputs("  ", file);
        print_foreign(file, FOREIGN_TERMINAL, FOREIGN(n->file));
        fputs(n->file ? ":" : "", file);
        if (n->line)
            fprintf(file, "%d:", n->line);
        fprintf(file, "%s%s", n->file || n->line ? " " : "", n->kind == LAM_CHECK_DIAGNOSTIC_HINT ? "hint: " : "");
        print_foreign(file, FOREIGN_TERMINAL, FOREIGN(n->text));
        putc('\n', file);
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
                check_scene_word(s), s->looks_like ? ", looks like " : "", s->looks_like ? s->looks_like : "");
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
                "None of %llu mistakes and sets of mistakes explains the difference; the search ended at its limit "
                "(--search-limit).",
                tried);
    else if (tried)
        fprintf(file,
                "None of the %llu known mistakes and sets of mistakes that were tried explains the "
                "difference.",
                tried);
    else
        fputs("No known mistake explains the difference.", file);
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
    fprintf(file, "It looks like%s:\n", r->finding_count > 1 ? " these together" : " this");
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
    print_foreign(file, FOREIGN_TERMINAL, FOREIGN(shader));
    fprintf(file, " %s\n", check_verdict_text(r->verdict));
    fprintf(file, "  contract %s; lit in the %s shader%s%s%s\n", r->contract, r->vertex_lit ? "vertex" : "fragment",
            r->made_vertex ? "; the vertex shader was generated" : "", r->driver[0] ? "; " : "", r->driver);
    print_diagnostics(file, r);
    print_scenes(file, r, tolerance);
    print_findings(file, r);
}

void check_report_line(FILE *file, const struct check_result *result)
{
    const lam_check_report *r = &result->report;
    char name[FOREIGN_SIZE];
    fprintf(file, "%-32s ", foreign_text(result->submission->name, name));
    if (result->error.code) {
        fputs("no verdict\n", file);
        return;
    }
    struct check_points points = check_points_of(r);
    fprintf(file, "%-12s %2g of %2g", lam_check_verdict_name(r->verdict), points.earned, points.possible);
    for (int i = 0; i < r->finding_count; i++)
        fprintf(file, "%s%s", i ? ", " : "  ", r->findings[i].mistake);
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
