// check_page.c: writes the page of a class: one HTML file without scripts. The page shows the sheets in the same
// folder.
#include "check.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "foreign.h"
#include "output.h"
#include "writer.h"

enum { MAX_COUNTED = 512 };

struct counted {
    const char *name;
    int count;
};

struct check_page {
    FILE *rows; // the rows of the table
    char *text;
    size_t size;
    int count;
    struct counted verdicts[16], mistakes[MAX_COUNTED];
};

struct check_page *check_page_make(lam_error *error)
{
    struct check_page *page = calloc(1, sizeof *page);
    if (page)
        page->rows = open_memstream(&page->text, &page->size);
    if (page && page->rows)
        return page;
    free(page);
    complain(error, LAM_MACHINE, "out of memory");
    return NULL;
}

void check_page_free(struct check_page *page)
{
    if (!page)
        return;
    if (page->rows)
        fclose(page->rows);
    free(page->text);
    free(page);
}

static void put_address(FILE *file, const char *path)
{
    const char *slash = strrchr(path, '/');
    html_address(file, slash ? slash + 1 : path);
}

// Adds 1 to the count of a name, which must be a static string.
static void count(struct counted *list, size_t capacity, const char *name)
{
    for (size_t i = 0; i < capacity; i++) {
        if (list[i].name && strcmp(list[i].name, name) != 0)
            continue;
        list[i].name = name;
        list[i].count++;
        return;
    }
}

static void put_scene(FILE *file, const lam_check_scene *s)
{
    double earned = check_scene_points(s);
    if (earned < 0)
        return;
    fprintf(file, "<span class=\"%s\" title=\"", s->passes ? "good" : "bad");
    html_text(file, FOREIGN(s->description));
    fprintf(file, ": largest difference %.3f, mean %.4f", s->maximum, s->mean);
    if (s->looks_like)
        fprintf(file, "; looks like %s", s->looks_like);
    fputs("\">", file);
    html_text(file, FOREIGN(s->name));
    fputs("</span> ", file);
}

static void put_findings(FILE *file, const lam_check_report *r)
{
    for (int i = 0; i < r->finding_count; i++) {
        const lam_check_finding *f = &r->findings[i];
        fprintf(file, "<p><b>%s</b>: ", f->mistake);
        html_text(file, FOREIGN(f->explanation));
        if (f->also)
            fprintf(file, " <i>(or %s: the same pictures)</i>", f->also);
        fputs("<br><code>", file);
        html_text(file, FOREIGN(f->correction));
        fputs("</code></p>", file);
    }
    if (!r->finding_count && r->verdict == LAM_CHECK_DIFFERS) {
        fputs("<p>", file);
        check_print_no_finding(file, r);
        fputs("</p>", file);
    } else if (r->verdict != LAM_CHECK_DIFFERS && r->verdict != LAM_CHECK_PASSES)
        fprintf(file, "<p>It %s.</p>", check_verdict_text(r->verdict));
    for (int i = 0; i < r->diagnostic_count; i++) {
        const lam_check_diagnostic *d = &r->diagnostics[i];
        const char *slash = d->file ? strrchr(d->file, '/') : NULL;
        fputs("<p class=\"note\">", file);
        html_text(file, FOREIGN(slash ? slash + 1 : d->file));
        if (d->line)
            fprintf(file, ":%d", d->line);
        fputs(d->file || d->line ? ": " : "", file);
        html_text(file, FOREIGN(d->text));
        fputs("</p>", file);
    }
}

static void put_terms(FILE *file, const struct check_points *points)
{
    static const char *const names[] = {"ambient", "diffuse", "specular"};
    for (int t = 0; t < 3; t++)
        if (points->terms[t] >= 0)
            fprintf(file, "<span class=\"%s\">%s %.0f %%</span> ", points->terms[t] < 1 ? "bad" : "good", names[t],
                    100 * points->terms[t]);
}

void check_page_add(struct check_page *page, const struct check_result *result)
{
    FILE *file = page->rows;
    const lam_check_report *r = &result->report;
    const char *verdict = result->error.code ? "no verdict" : lam_check_verdict_name(r->verdict);
    page->count++;
    count(page->verdicts, sizeof page->verdicts / sizeof *page->verdicts, verdict);
    fputs("<tr><th>", file);
    html_text(file, result->submission->name);
    fprintf(file, "</th><td class=\"%s\">%s</td>",
            !result->error.code && r->verdict == LAM_CHECK_PASSES ? "good" : "bad", verdict);
    if (result->error.code) {
        fputs("<td></td><td></td><td>", file);
        html_text(file, FOREIGN(result->error.text));
        fputs("</td></tr>\n", file);
        return;
    }
    struct check_points points = check_points_of(r);
    fprintf(file, "<td class=\"number\">%g of %g</td><td>", points.earned, points.possible);
    put_terms(file, &points);
    fputs("<br>", file);
    for (int i = 0; i < r->scene_count; i++)
        put_scene(file, &r->scenes[i]);
    fputs("</td><td>", file);
    put_findings(file, r);
    if (result->sheet) {
        fputs("<details><summary>pictures</summary><img loading=\"lazy\" alt=\"\" src=\"", file);
        put_address(file, result->sheet);
        fputs("\"></details>", file);
    } else if (result->sheet_error.code) {
        fputs("<p class=\"note\">", file);
        html_text(file, FOREIGN(result->sheet_error.text));
        fputs("</p>", file);
    }
    fputs("</td></tr>\n", file);
    for (int i = 0; i < r->finding_count; i++)
        count(page->mistakes, MAX_COUNTED, r->findings[i].mistake);
}

static int by_count(const void *a, const void *b)
{
    return ((const struct counted *)b)->count - ((const struct counted *)a)->count;
}

static void put_counts(FILE *file, const char *title, struct counted *list, size_t capacity, int total)
{
    size_t used = 0;
    while (used < capacity && list[used].name)
        used++;
    if (!used)
        return;
    qsort(list, used, sizeof *list, by_count);
    fprintf(file, "<h2>%s</h2><table class=\"counts\">\n", title);
    for (size_t i = 0; i < used; i++)
        fprintf(file, "<tr><td>%s</td><td class=\"number\">%d</td><td><div style=\"width:%.1fem\"></div></td></tr>\n",
                list[i].name, list[i].count, 20.0 * list[i].count / total);
    fputs("</table>\n", file);
}

static const char style[] =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;background:#fff;margin:2em auto;padding:0 1em;max-width:80em}"
    "table{border-collapse:collapse}th,td{text-align:left;vertical-align:top;padding:.45em .7em;border-bottom:1px "
    "solid "
    "#ddd}.counts td{border:0;padding:.1em .7em}.counts div{background:#7a9cc6;height:.8em;margin-top:.35em}"
    ".number{text-align:right;white-space:nowrap}.good{color:#0a7d33}.bad{color:#b3261e}span{white-space:nowrap}"
    "p{margin:0 0 .5em}.note{color:#555}code{background:#f3f3f3;padding:.1em .3em}img{max-width:100%}";

static void write_page(FILE *file, struct check_page *page, const char *title)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">" HTML_POLICY "<title>", file);
    html_text(file, FOREIGN(title));
    fprintf(file, "</title><meta name=\"viewport\" content=\"width=device-width\"><style>%s</style></head><body>\n<h1>",
            style);
    html_text(file, FOREIGN(title));
    fprintf(file,
            "</h1><p>%d submissions, checked by <code>lambent check</code>. Each scene that matches the reference "
            "scores one point. Move the pointer over its name to see the differences.</p>\n",
            page->count);
    put_counts(file, "Verdicts", page->verdicts, sizeof page->verdicts / sizeof *page->verdicts, page->count);
    put_counts(file, "Mistakes", page->mistakes, MAX_COUNTED, page->count);
    fputs("<h2>Submissions</h2><table><tr><th>submission</th><th>verdict</th><th>points</th><th>terms and scenes</th>"
          "<th>mistakes</th></tr>\n",
          file);
    fflush(page->rows);
    fwrite(page->text, 1, page->size, file);
    fputs("</table></body></html>\n", file);
}

char *check_page_path(const char *folder, lam_error *error)
{
    char *path = NULL;
    size_t length = strlen(folder);
    if (asprintf(&path, "%s%sindex.html", folder, length && folder[length - 1] != '/' ? "/" : "") >= 0)
        return path;
    complain(error, LAM_MACHINE, "out of memory");
    return NULL;
}

bool check_page_write(struct check_page *page, const char *folder, const char *title, lam_error *error)
{
    char *text = NULL, *path = check_page_path(folder, error);
    size_t size = 0;
    FILE *file = path ? open_memstream(&text, &size) : NULL;
    if (file)
        write_page(file, page, title);
    bool ok = path && ((file && fclose(file) == 0) || complain(error, LAM_MACHINE, "out of memory"));
    ok = ok && writer_save(path, &(lam_bytes){.data = text, .size = size}, false, error);
    free(text);
    free(path);
    return ok;
}
