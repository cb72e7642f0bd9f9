// view_page.c: makes the page of the viewer.
#include "view_page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "foreign.h"
#include "json.h"
#include "page.h"
#include "report.h"

enum { PAGE_MAX = 64 << 20 }; // the maximum size of the page

// --- the options of the command line

// Stores the real paths of the environment's files in `files`.
static bool take_environment(struct view_files *files, const struct page_model *model, lam_error *error)
{
    files->environment = calloc((size_t)model->count + 1, sizeof *files->environment);
    if (!files->environment)
        return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; i < model->count; i++) {
        char *real = realpath(model->files[i].path, NULL);
        if (!real)
            return complain(error, LAM_CANNOT_READ, "option '--environment': %s: cannot read", model->files[i].path);
        files->environment[files->environment_count++] = real;
    }
    return true;
}

struct words {
    FILE *words, *fragment;
    const char *environment; // NULL leaves the value unchanged
};

static void put_option(void *user, const char *name, const char *value)
{
    const struct words *w = user;
    char *argument = NULL;
    if (!option_is_in(option_find(name), IN_PAGE))
        return;
    if (option_find(name)->kind == VALUE_ENVIRONMENT && w->environment)
        value = w->environment;
    if (asprintf(&argument, "--%s%s%s", name, value ? "=" : "", value ? value : "") < 0)
        return;
    fwrite(argument, 1, strlen(argument) + 1, w->words);
    putc('&', w->fragment);
    html_address(w->fragment, argument);
    free(argument);
}

static bool take_options(struct view_page *page, const struct options *options, struct view_files *files,
                         lam_error *error)
{
    struct page_model model = {0};
    size_t size = 0;
    bool ok = page_model_add_environment(options, &model, error) && take_environment(files, &model, error);
    struct words w = {.environment = model.environment};
    w.words = ok ? open_memstream(&page->words, &page->words_size) : NULL;
    w.fragment = w.words ? open_memstream(&page->fragment, &size) : NULL;
    if (ok && !w.fragment)
        ok = complain(error, LAM_MACHINE, "out of memory");
    if (ok)
        each_given_option(options, put_option, &w);
    bool lost = w.words && fclose(w.words) != 0;
    lost |= w.fragment && fclose(w.fragment) != 0;
    if (lost && ok)
        ok = complain(error, LAM_MACHINE, "out of memory");
    page_model_free(&model);
    return ok;
}

// --- the page

static void put_json(FILE *out, const char *id, const char *json)
{
    fprintf(out, "<script type=\"application/json\" id=\"%s\">", id);
    html_script(out, json);
    fputs("</script>\n", out);
}

static bool put_data(FILE *out, const struct view_page *page, const char *model, lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *list = open_memstream(&text, &size);
    if (!list)
        return complain(error, LAM_MACHINE, "out of memory");
    struct json json = {.file = list};
    if (model) {
        json_open(&json, NULL, '[');
        json_text(&json, NULL, model);
        for (const char *argument = page->words; argument < page->words + page->words_size;
             argument += strlen(argument) + 1)
            json_text(&json, NULL, argument);
        json_close(&json, ']');
    }
    bool ok = fclose(list) == 0 || complain(error, LAM_MACHINE, "out of memory");
    if (ok && model)
        put_json(out, "inside-words", text);
    char served[64];
    snprintf(served, sizeof served, "{\"gallery\":%s,\"threads\":%s}", model ? "false" : "true",
             page->module ? "true" : "false");
    if (ok)
        put_json(out, "served", served);
    free(text);
    return ok;
}

// The policy in the page's file forbids all connections. own_policy replaces this policy, and allows connections to the
// page's own server.
static const char *const policy = "; base-uri 'none'", *const own_policy = "; connect-src 'self'; base-uri 'none'";

static bool fill(struct view_page *page, const char *text, const char *model, lam_error *error)
{
    const char *directive = strstr(text, policy), *end = NULL;
    for (const char *at = text; (at = strstr(at, "</body>")); at++)
        end = at;
    if (!directive || !end || directive > end)
        return complain(error, LAM_UNSUPPORTED,
                        "the page given by LAMBENT_PAGE or by the build is not the lambent.html of `make web`");
    FILE *out = open_memstream(&page->text, &page->size);
    if (!out)
        return complain(error, LAM_MACHINE, "out of memory");
    fwrite(text, 1, (size_t)(directive - text), out);
    fputs(own_policy, out);
    directive += strlen(policy);
    fwrite(directive, 1, (size_t)(end - directive), out);
    bool ok = put_data(out, page, model, error);
    fputs(end, out);
    if ((ferror(out) | fclose(out)) && ok)
        ok = complain(error, LAM_MACHINE, "out of memory");
    return ok;
}

// Reads the module that supports threads. If `make web` has made this module, it is in the folder of the page.
static bool take_module(struct view_page *page, const char *path, lam_error *error)
{
    const char *slash = strrchr(path, '/');
    char *beside = NULL;
    if (asprintf(&beside, "%.*slambent-threads.wasm", slash ? (int)(slash + 1 - path) : 0, path) < 0)
        return complain(error, LAM_MACHINE, "out of memory");
    bool exists = access(beside, R_OK) == 0;
    page->module = exists ? page_file_read(beside, PAGE_MAX, &page->module_size, error) : NULL;
    free(beside);
    return page->module || !exists;
}

bool view_page_make(struct view_page *page, const struct options *options, const char *model, struct view_files *files,
                    lam_error *error)
{
    size_t size = 0;
    *page = (struct view_page){0};
    char *path = page_file_find(error), *text = path ? page_file_read(path, PAGE_MAX, &size, error) : NULL;
    bool ok = text && take_module(page, path, error) && take_options(page, options, files, error) &&
              fill(page, text, model, error);
    free(path);
    free(text);
    return ok;
}

void view_page_free(struct view_page *page)
{
    free(page->text);
    free(page->words);
    free(page->fragment);
    free(page->module);
    *page = (struct view_page){0};
}
