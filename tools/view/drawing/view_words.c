// view_words.c: parses the page's command line, and converts its paths to paths on this machine.
#include "view_words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command_table.h"
#include "console.h"
#include "environment_option.h"
#include "job.h"
#include "limit_options.h"
#include "page.h"

// Converts the path of a served file from a path in the page to a path on this machine, allocated with malloc. Fails
// with LAM_CANNOT_READ (the file is not served) or LAM_LIMIT.
static char *machine_path(const struct view_files *files, const char *path, lam_error *error)
{
    int file = view_files_open(files, path);
    if (file < 0) {
        complain(error, LAM_CANNOT_READ,
                 "%.400s: cannot read: there is no such file in the viewer's folder or below it",
                 path + (*path == '/'));
        return NULL;
    }
    close(file);
    char *found = view_files_path(files, path);
    if (!found)
        complain(error, LAM_MACHINE, "out of memory");
    return found;
}

// Converts the paths in the value of --environment (one file or six) to paths on this machine.
static bool take_environment(struct view_words *w, const struct view_files *files, struct options *out,
                             lam_error *error)
{
    if (!out->shading.environment || environment_option_built_in(out->shading.environment))
        return true;
    size_t size = 0;
    FILE *list = open_memstream(&w->environment, &size);
    char *copy = strdup(out->shading.environment), *rest = copy;
    bool ok = (list && copy) || complain(error, LAM_MACHINE, "out of memory");
    for (char *part; ok && (part = strsep(&rest, ","));) {
        char *path = machine_path(files, part, error);
        ok = path != NULL;
        if (path)
            fprintf(list, "%s%s", part == copy ? "" : ",", path);
        free(path);
    }
    free(copy);
    if (list && fclose(list) != 0 && ok)
        ok = complain(error, LAM_MACHINE, "out of memory");
    if (ok)
        out->shading.environment = w->environment;
    return ok;
}

// Accepts options of the picture, including built-in looks, but not look files.
static bool fits(const struct option *option, const struct options *given)
{
    if (strcmp(option->name, "look") == 0)
        return look_find(given->lighting.look) != NULL;
    return option_is_in(option, IN_PAGE) || strcmp(option->name, "compress") == 0 ||
           strcmp(option->name, "quality") == 0;
}

static bool check(const struct options *given, lam_error *error)
{
    for (const struct option *o = option_table; o->name; o++)
        if (given->given[o - option_table] && !fits(o, given))
            return complain(error, LAM_BAD_ARGUMENT, "option '--%s' does not apply to the picture on a page", o->name);
    if (given->picture.show && strcmp(given->picture.show, "all") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--show all' makes several pictures, and a page shows one");
    return job_check_options(given, error);
}

static void take_limits(const struct options *limits, struct options *out)
{
    struct limits_options own = out->limits;
    out->limits = limits->limits;
    out->limits.allow_paths = own.allow_paths; // each of the options frees its own list
    out->limits.sandbox = own.sandbox;
    out->limits.files_inside = true;
    out->work.threads = limits->work.threads;
}

bool view_words_parse(struct view_words *w, const char *text, size_t size, const struct view_files *files,
                      const struct options *limits, struct options *out, lam_error *error)
{
    int count = 0;
    *w = (struct view_words){.text = malloc(size + 1)};
    *out = option_defaults();
    for (size_t i = 0; i < size; i++)
        count += !text[i];
    w->words = calloc((size_t)count + 1, sizeof *w->words);
    if (!w->text || !w->words)
        return complain(error, LAM_MACHINE, "out of memory");
    memcpy(w->text, text, size);
    w->text[size] = 0;
    char *at = w->text;
    for (int i = 0; i < count; i++) {
        w->words[i] = at;
        at += strlen(at) + 1;
    }
    if (!count)
        return complain(error, LAM_BAD_ARGUMENT, "no model given, expected its path");
    w->page_model = w->words[0];
    int operands =
        options_parse(count - 1, w->words + 1, command_table[COMMAND_render].groups | 1ull << GROUP_SHAPE, out, error);
    if (operands > 0)
        return complain(error, LAM_BAD_ARGUMENT, "unexpected argument '%.100s', expected one model", w->words[1]);
    if (operands < 0 || !check(out, error) || !job_check_formula(w->page_model, out, error) ||
        !take_environment(w, files, out, error))
        return false;
    take_limits(limits, out);
    w->model = job_model_is_shape(w->page_model) ? strdup(w->page_model) : machine_path(files, w->page_model, error);
    if (!w->model && job_model_is_shape(w->page_model))
        complain(error, LAM_MACHINE, "out of memory");
    return w->model != NULL;
}

void view_words_free(struct view_words *w)
{
    free(w->text);
    free(w->words);
    free(w->model);
    free(w->environment);
    *w = (struct view_words){0};
}
