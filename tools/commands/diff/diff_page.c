// diff_page.c: builds the page of `lambent diff`: the models before and after in one self-contained HTML file without
// scripts.
#include "diff.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "foreign.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
    "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n<meta name=\"viewport\" "
    "content=\"width=device-width\">\n<title>lambent diff</title>\n<style>\n"
    "body { font: 14px/1.4 system-ui, sans-serif; margin: 2em; color: #222; background: #fff }\n"
    "h1 { font-size: 1.4em } h2 { font-size: 1.1em; margin-top: 2em } h3 { font-size: 1em; margin: 1.5em 0 .3em }\n"
    "code { overflow-wrap: anywhere } .bad { color: #b00020 } small, .about { color: #666 }\n"
    ".row { display: flex; flex-wrap: wrap; gap: 12px } figure { margin: 0 }\n"
    "figcaption { font-size: 12px; color: #666 } img { background: #f2f2f2; border-radius: 4px; max-width: 100% }\n"
    "</style>\n";

static const char *text_of(const json_t *record, const char *key)
{
    return json_string_value(json_object_get(record, key));
}

static void put_figure(FILE *out, const json_t *record, const char *key, const char *caption)
{
    const char *png = text_of(record, key);
    if (!png)
        return;
    fprintf(out, "<figure><img alt=\"%s\" src=\"data:image/png;base64,%s\"><figcaption>%s</figcaption></figure>\n",
            caption, png, caption);
}

// Writes "12 triangles" or "12 triangles → 14 triangles".
static void put_counts(FILE *out, const json_t *record)
{
    const char *before = text_of(record, "counts_before"), *after = text_of(record, "counts_after");
    bool both = before && after && strcmp(before, after) != 0;
    fputs("<small>", out);
    html_text(out, FOREIGN(both || !after ? before : after));
    if (both) {
        fputs(" → ", out);
        html_text(out, FOREIGN(after));
    }
}

static void put_model(FILE *out, const struct model_diff *diff, size_t model, const json_t *record, enum change change)
{
    fputs("<h3><code>", out);
    html_text(out, FOREIGN(diff->pairs[model].name));
    fputs("</code></h3>\n", out);
    if (change == CHANGE_FAILED) {
        fputs("<p class=\"bad\">", out);
        html_text(out, FOREIGN(text_of(record, "error")));
        fputs("</p>\n", out);
        return;
    }
    put_counts(out, record);
    if (change == CHANGE_CHANGED)
        fprintf(out, ", %.4g %% of the pixels differ by more than 1/255; the largest difference is %.3g/255",
                100 * json_number_value(json_object_get(record, "share_over_1")),
                255 * json_number_value(json_object_get(record, "maximum")));
    fputs("</small>\n<div class=\"row\">\n", out);
    put_figure(out, record, "before", "before");
    put_figure(out, record, "after", "after");
    put_figure(out, record, "where", "difference");
    fputs("</div>\n", out);
    if (!text_of(record, "before") && !text_of(record, "after"))
        fprintf(out, "<p class=\"about\">The page has the pictures of %d models; this one came after them.</p>\n",
                PAGE_ROWS);
}

static void put_section(FILE *out, const struct model_diff *diff, json_t *const *records, enum change change)
{
    static const char *const titles[CHANGE_COUNT] = {"Changed", "Failed", "Added", "Removed", "Equal"};
    if (!diff->counts[change])
        return;
    bool list = change == CHANGE_EQUAL;
    fprintf(out, list ? "<details><summary>%s: %zu</summary>\n<ul>\n" : "<h2>%s: %zu</h2>\n", titles[change],
            diff->counts[change]);
    for (size_t i = 0; i < diff->plan.count; i++) {
        if (diff_change_of(records[i]) != change)
            continue;
        if (!list) {
            put_model(out, diff, i, records[i], change);
            continue;
        }
        fputs("<li><code>", out);
        html_text(out, FOREIGN(diff->pairs[i].name));
        fputs("</code></li>\n", out);
    }
    fputs(list ? "</ul></details>\n" : "", out);
}

char *diff_page(const struct model_diff *diff, json_t *const *records)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs(head, out);
    const char *title = diff->options->captions.title;
    fputs("<h1>", out);
    html_text(out, FOREIGN(title ? title : diff->old));
    fputs(title ? "" : " → ", out);
    html_text(out, FOREIGN(title ? "" : diff->new));
    fprintf(out, "</h1>\n<p class=\"about\">lambent %s:", lam_version());
    for (int i = 0; i < CHANGE_COUNT; i++)
        fprintf(out, "%s %zu %s", i ? "," : "", diff->counts[i], change_names[i]);
    fprintf(out, ". Both pictures of a model have one camera; differences are %g times as strong.</p>\n",
            diff->options->diff.gain);
    for (int i = 0; i < CHANGE_COUNT; i++)
        put_section(out, diff, records, (enum change)i);
    fputs("</html>\n", out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}
