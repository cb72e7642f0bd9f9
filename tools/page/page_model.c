// page_model.c: collects the files and the command line of a model for a page.
#include "page.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "console.h"
#include "file_io.h"
#include "foreign.h"
#include "environment_option.h"
#include "json.h"
#include "report.h"

// --- files

static bool add(struct page_model *model, const char *path, char *inside, lam_error *error)
{
    struct page_file *grown = realloc(model->files, (size_t)(model->count + 1) * sizeof *grown);
    char *copy = grown ? strdup(path) : NULL;
    if (grown)
        model->files = grown;
    if (!copy || !inside) {
        free(copy);
        free(inside);
        return complain(error, LAM_MACHINE, "out of memory");
    }
    model->files[model->count++] = (struct page_file){copy, inside};
    return true;
}

// Returns whether ".." in a name leads out of the starting folder.
static bool climbs_out(const char *name)
{
    int depth = 0;
    for (const char *at = name; *at; at += strspn(at, "/")) {
        size_t length = strcspn(at, "/");
        bool here = length == 1 && at[0] == '.', up = length == 2 && at[0] == '.' && at[1] == '.';
        depth += up ? -1 : here || !length ? 0 : 1;
        if (depth < 0)
            return true;
        at += length;
    }
    return false;
}

// Adds the model and the files that the model names. In the page, the model's folder is "/".
static bool add_files(const struct job *job, struct page_model *model, lam_error *error)
{
    const char *slash = strrchr(job->model, '/'), *path;
    int length = slash ? (int)(slash + 1 - job->model) : 0;
    bool ok = true;
    for (int i = 0; ok && (path = lam_scene_file(job->scene, i)); i++) {
        const char *name = path + length;
        char *inside = NULL;
        bool beside = strncmp(path, job->model, (size_t)length) == 0 && *name != '/' && !climbs_out(name);
        struct stat about;
        int found = lam_path_stat(path, &about);
        bool out = !beside || (found != 0 && (errno == EXDEV || errno == EMLINK)); // a link that leads out
        if (!out && (found != 0 || !S_ISREG(about.st_mode))) // the page will also report the missing file
            continue;
        if (out) {
            ok = complain(
                error, LAM_UNSUPPORTED,
                "%s: is outside the folder of %s, and a page cannot contain files of other folders; copy it there",
                path, job->model);
            break;
        }
        if (asprintf(&inside, "/%s", name) < 0)
            inside = NULL;
        ok = add(model, path, inside, error);
    }
    return ok;
}

bool page_model_add_environment(const struct options *options, struct page_model *model, lam_error *error)
{
    const char *text = options->shading.environment, *paths[LAM_FACE_COUNT] = {text};
    if (!text || environment_option_built_in(text))
        return true;
    char *copy = strchr(text, ',') ? environment_option_faces(text, paths, error) : strdup(text);
    if (!copy)
        return strchr(text, ',') ? false : complain(error, LAM_MACHINE, "out of memory");
    size_t size = 0;
    FILE *value = open_memstream(&model->environment, &size);
    bool ok = value || complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; ok && i < (strchr(text, ',') ? LAM_FACE_COUNT : 1); i++) {
        const char *slash = strrchr(paths[i], '/');
        char *inside = NULL;
        if (asprintf(&inside, "/.environment/%d-%s", i + 1, slash ? slash + 1 : paths[i]) < 0)
            inside = NULL;
        if (inside)
            fprintf(value, "%s%s", i ? "," : "", inside);
        ok = add(model, paths[i], inside, error);
    }
    if (value && fclose(value) != 0 && ok)
        ok = complain(error, LAM_MACHINE, "out of memory");
    free(copy);
    return ok;
}

bool page_model_list(const struct job *job, struct page_model *model, lam_error *error)
{
    *model = (struct page_model){0};
    bool ok = add_files(job, model, error) && page_model_add_environment(job->options, model, error);
    if (!ok)
        page_model_free(model);
    return ok;
}

void page_model_free(struct page_model *model)
{
    for (int i = 0; i < model->count; i++) {
        free(model->files[i].path);
        free(model->files[i].inside);
    }
    free(model->files);
    free(model->environment);
    *model = (struct page_model){0};
}

// File types that the page's module cannot decode.
static const struct {
    const char *ending, *extension; // NULL if the name's ending, or the glTF extension, does not identify the type
    const char *sentence;
} unreadable[] = {
    {".webp", "EXT_texture_webp", "the page cannot read pictures in WebP"},
    {".exr", NULL, "the page cannot read pictures in EXR"},
};

static bool has_one(const struct page_model *model, const lam_file_info *info, size_t kind)
{
    bool found = false;
    for (int i = 0; unreadable[kind].ending && i < model->count; i++) {
        const char *dot = strrchr(model->files[i].path, '.');
        found |= dot && strcasecmp(dot, unreadable[kind].ending) == 0;
    }
    for (int i = 0; unreadable[kind].extension && i < info->extension_count; i++)
        found |= strcmp(info->extensions[i].name, unreadable[kind].extension) == 0;
    return found;
}

const char *page_model_lacks(const struct page_model *model, const lam_file_info *info, int index)
{
    for (size_t kind = 0; kind < sizeof unreadable / sizeof *unreadable; kind++)
        if (has_one(model, info, kind) && index-- == 0)
            return unreadable[kind].sentence;
    return NULL;
}

// --- words

struct words {
    struct json json;
    const struct page_model *model;
    bool failed; // out of memory
};

static void put_option(void *user, const char *name, const char *value)
{
    struct words *words = user;
    char *argument = NULL;
    if (!option_is_in(option_find(name), IN_PAGE))
        return;
    if (option_find(name)->kind == VALUE_ENVIRONMENT && words->model->environment)
        value = words->model->environment;
    if (asprintf(&argument, "--%s%s%s", name, value ? "=" : "", value ? value : "") < 0)
        argument = NULL;
    words->failed |= !argument;
    json_text(&words->json, NULL, argument);
    free(argument);
}

bool page_model_words(FILE *out, const struct job *job, const struct options *given, const struct page_model *model,
                      lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *list = open_memstream(&text, &size);
    if (!list)
        return complain(error, LAM_MACHINE, "out of memory");
    struct words words = {.json = {.file = list}, .model = model};
    json_open(&words.json, NULL, '[');
    bool shape = lam_shape_find(job->model) >= 0 || !model->count;
    json_text(&words.json, NULL, shape ? job->model : model->files[0].inside);
    each_given_option(given, put_option, &words);
    json_close(&words.json, ']');
    bool ok = fclose(list) == 0 && !words.failed;
    if (ok)
        html_script(out, text);
    free(text);
    return ok || complain(error, LAM_MACHINE, "out of memory");
}
