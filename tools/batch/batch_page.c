// batch_page.c: writes the page of --report, an HTML file without scripts that shows failures first. Writes thumbnails
// to a folder beside the file.
#include "batch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "console.h"
#include "foreign.h"
#include "journal.h"
#include "output.h"
#include "writer.h"
#include "xxh64.h"

enum { THUMBNAIL = 160 }; // pixels of the longer side

// --- thumbnails

// Returns the file of a picture's thumbnail, allocated with malloc: "page-files/0123456789abcdef.png" for "page.html".
static char *thumbnail_path(const char *page, const char *output)
{
    struct xxh64 hash;
    const char *slash = strrchr(page, '/'), *dot = strrchr(slash ? slash : page, '.');
    char *path = NULL;
    xxh64_start(&hash);
    xxh64_add_text(&hash, output);
    int stem = (int)(dot ? (size_t)(dot - page) : strlen(page));
    return asprintf(&path, "%.*s-files/%016llx.png", stem, page, (unsigned long long)xxh64_end(&hash)) < 0 ? NULL
                                                                                                           : path;
}

bool batch_page_is_thumbnail(const char *page, const char *path)
{
    char *other = thumbnail_path(page, "");
    size_t length = strlen(path), name = sizeof "0123456789abcdef.png" - 1;
    bool is = other && length == strlen(other) && strncmp(path, other, length - name) == 0 &&
              strspn(path + length - name, "0123456789abcdef") == 16 && strcmp(path + length - 4, ".png") == 0;
    free(other);
    return is;
}

static bool make_thumbnail(const char *output, const char *thumbnail)
{
    lam_image picture = {0}, small = {0};
    lam_error error;
    if (!lam_image_load_linear(&picture, output, LAM_COLOR_SRGB, NULL, &error))
        return false;
    bool ok = shrink_linear(&picture, THUMBNAIL, &small, &error);
    lam_save_params params = {.threads = 1};
    lam_bytes png = {0};
    ok = ok && lam_image_encode(&small, "png", &params, &png, &error) && writer_save(thumbnail, &png, false, &error);
    lam_bytes_free(&png);
    lam_image_free(&picture);
    lam_image_free(&small);
    return ok;
}

static bool is_there(const char *thumbnail, const char *output)
{
    struct stat picture, found;
    return thumbnail && lam_path_stat(thumbnail, &found) == 0 &&
           (lam_path_stat(output, &picture) != 0 || picture.st_mtime <= found.st_mtime);
}

void batch_page_thumbnail(const char *page, const char *output, bool is_new)
{
    char *thumbnail = thumbnail_path(page, output);
    if (thumbnail && (is_new || !is_there(thumbnail, output)))
        make_thumbnail(output, thumbnail);
    free(thumbnail);
}

static bool has_picture(const struct batch_picture *picture)
{
    return picture->outcome == PICTURE_WRITTEN || picture->outcome == PICTURE_SAME ||
           picture->outcome == PICTURE_BEFORE;
}

void batch_page_thumbnails(const struct batch *b, const struct batch_work *u)
{
    for (int i = 0; b->options->batch.report_page && i < u->task.plan->view_count; i++)
        if (has_picture(&u->pictures[i]))
            batch_page_thumbnail(b->options->batch.report_page, u->outputs[i],
                                 u->pictures[i].outcome == PICTURE_WRITTEN);
}

bool batch_page_lacks(const struct batch *b, const struct batch_work *u)
{
    bool lacks = false;
    for (int i = 0; b->options->batch.report_page && !lacks && i < u->task.plan->view_count; i++) {
        char *thumbnail = thumbnail_path(b->options->batch.report_page, u->outputs[i]);
        lacks = has_picture(&u->pictures[i]) && !is_there(thumbnail, u->outputs[i]);
        free(thumbnail);
    }
    return lacks;
}

// --- the page

char *batch_page_output(const char *page, bool own, const json_t *record)
{
    char *path = journal_path(journal_value(record, "output").text), *at = path;
    page += strncmp(page, "./", 2) == 0 ? 2 : 0;
    at += at && strncmp(at, "./", 2) == 0 ? 2 : 0;
    const char *slash = strrchr(page, '/');
    size_t folder = slash ? (size_t)(slash - page) + 1 : 0;
    bool below = at && strncmp(at, page, folder) == 0 && at[folder] != '/';
    at += below ? folder : 0;
    for (; below && at; at = strchr(at, '/') ? strchr(at, '/') + 1 : NULL)
        below = strncmp(at, "..", 2) != 0 || (at[2] && at[2] != '/');
    if (own || below)
        return path;
    free(path);
    return NULL;
}

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n" HTML_POLICY "<meta name=\"viewport\" "
    "content=\"width=device-width\">\n"
    "<title>%s</title>\n<style>\n"
    "body { font: 14px/1.4 system-ui, sans-serif; margin: 2em; color: #222; background: #fff }\n"
    "h1 { font-size: 1.4em } h2 { font-size: 1.1em; margin-top: 2em }\n"
    "li { margin: .4em 0 } .bad { color: #b00020 } small, .about { color: #666 }\n"
    ".sheet { display: grid; grid-template-columns: repeat(auto-fill, 176px); gap: 16px }\n"
    "figure { margin: 0 } figcaption { overflow-wrap: anywhere; font-size: 12px }\n"
    ".thumb { display: flex; width: 176px; height: 176px; align-items: center; justify-content: center;\n"
    "  background: #f2f2f2; border-radius: 4px }\n"
    "</style>\n";

// Writes the address of a file relative to the page.
static void put_address(FILE *out, const char *page, const char *path)
{
    size_t common = 0;
    for (size_t i = 0; page[i] && page[i] == path[i]; i++)
        if (page[i] == '/')
            common = i + 1;
    if (path[0] != '/' || page[0] == '/')
        for (const char *slash = page + common; (slash = strchr(slash, '/')); slash++)
            fputs("../", out);
    else
        common = 0;
    html_address(out, path + common);
}

static void put_failure(FILE *out, const json_t *record)
{
    fputs("<li><b class=\"bad\">", out);
    html_text(out, journal_value(record, "class"));
    fputs("</b> ", out);
    html_text(out, journal_value(record, "model"));
    fputs("<br>", out);
    html_text(out, journal_value(record, "error"));
    long long attempt = json_integer_value(json_object_get(record, "attempt"));
    if (attempt > 1)
        fprintf(out, " <small>(%lld tries)</small>", attempt);
    fputs("</li>\n", out);
}

static void put_picture(FILE *out, const struct batch_page *page, const json_t *record)
{
    char *output = batch_page_output(page->path, page->own, record),
         *thumbnail = output ? thumbnail_path(page->path, output) : NULL;
    fputs("<figure>", out);
    if (thumbnail) {
        fputs("<a class=\"thumb\" href=\"", out);
        put_address(out, page->path, output);
        fputs("\"><img loading=\"lazy\" alt=\"\" src=\"", out);
        put_address(out, page->path, thumbnail);
        fputs("\"></a>", out);
    } else {
        fputs("<div class=\"thumb\">outside the page's folder</div>", out);
    }
    fputs("<figcaption>", out);
    html_text(out, journal_value(record, "model"));
    fputs("<br><small>", out);
    html_text(out, journal_value(record, "view"));
    fprintf(out, ", %lld triangles, %.1f ms</small>", json_integer_value(json_object_get(record, "triangles")),
            json_number_value(json_object_get(json_object_get(record, "times_ms"), "total")));
    const json_t *list = json_object_get(record, "warnings"), *warning;
    size_t i;
    json_array_foreach(list, i, warning)
    {
        fputs("<br><small class=\"bad\">", out);
        html_text(out, FOREIGN(json_string_value(warning)));
        fputs("</small>", out);
    }
    fputs("</figcaption></figure>\n", out);
    free(output);
    free(thumbnail);
}

// Writes the records of the failed pictures if `failures` is set; otherwise writes the records of the other pictures.
static void put_records(FILE *out, const struct batch_page *page, bool failures)
{
    for (size_t i = 0; i < page->record_count; i++) {
        json_t *record = page->record(page->user, i);
        bool failed = record && strcmp(journal_value(record, "class").text, "ok") != 0;
        if (record && failed && failures)
            put_failure(out, record);
        else if (record && !failed && !failures)
            put_picture(out, page, record);
        json_decref(record);
    }
}

static void put_page(FILE *out, const struct batch_page *page)
{
    const struct batch_tally *t = page->tally;
    size_t failed = t->failed + t->failed_before;
    fprintf(out, head, "lambent");
    fprintf(out,
            "<h1>%zu of %zu pictures</h1>\n<p class=\"about\">lambent %s: %zu written, %zu unchanged, %zu done before, "
            "%zu failed</p>\n",
            t->written + t->same + t->before, t->total, lam_version(), t->written, t->same, t->before, failed);
    if (failed)
        fputs("<h2>Failed</h2>\n<ul>\n", out);
    put_records(out, page, true);
    fputs(failed ? "</ul>\n<h2>Pictures</h2>\n<div class=\"sheet\">\n" : "<div class=\"sheet\">\n", out);
    put_records(out, page, false);
    fputs("</div>\n</html>\n", out);
}

bool batch_page_write(const struct batch_page *page, lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out)
        put_page(out, page);
    bool ok = (out && fclose(out) == 0) || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && writer_save(page->path, &(lam_bytes){text, size}, false, error);
    free(text);
    return ok;
}
