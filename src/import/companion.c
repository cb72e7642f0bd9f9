// companion.c: files that a model names: material libraries, pictures, the models of a scene file.
#include "companion.h"

#include "fail.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

bool confine(const char *name, char *out, size_t capacity)
{
    size_t length = strlen(name);
    if (length >= capacity)
        return false;
    for (size_t i = 0; i <= length; i++)
        out[i] = name[i] == '\\' ? '/' : name[i];
    bool escapes = out[0] == '/' || (out[0] && out[1] == ':');
    for (const char *component = out; *component;) {
        size_t end = strcspn(component, "/");
        escapes |= end == 2 && component[0] == '.' && component[1] == '.';
        component += end;
        component += strspn(component, "/");
    }
    if (escapes) {
        const char *last = path_name(out);
        memmove(out, last, strlen(last) + 1);
    }
    return true;
}

enum { PATH_CAPACITY = 4096 };

// Opens a file through the caller's function. `confined`: the name after confine().
static bool open_by_caller(const struct import_source *source, const char *confined, struct file_bytes *out,
                           lam_error *error)
{
    const struct companions *companions = source->open_state;
    if (!companions->open)
        return fail(error, LAM_CANNOT_READ, "%s: the file '%s' cannot be opened: the model has no folder", source->name,
                    confined);
    lam_bytes bytes = {0};
    if (!companions->open(companions->user, confined, &bytes, error))
        return false;
    bool ok = file_copy(bytes.data, bytes.size, source->call, out, error);
    if (companions->release)
        companions->release(companions->user, &bytes);
    else
        lam_bytes_free(&bytes);
    return ok;
}

// The path of a file in the model's folder.
static bool path_beside_model(const struct import_source *source, const char *name, char path[2 * PATH_CAPACITY],
                              lam_error *error)
{
    const char *model = ((const struct companions *)source->open_state)->model;
    int folder = name[0] == '/' ? 0 : (int)(path_name(model) - model);
    // "./-" is a file; "-" alone is standard input.
    int length =
        snprintf(path, 2 * PATH_CAPACITY, "%.*s%s%s", folder, model, folder == 0 && name[0] == '-' ? "./" : "", name);
    if (length < 0 || length >= 2 * PATH_CAPACITY)
        return fail(error, LAM_CANNOT_READ, "%s: the path to '%.80s' is too long", source->name, name);
    return true;
}

// Refuses pipes and devices, which could block.
static bool read_regular(const struct import_source *source, const char *path, struct file_bytes *out, lam_error *error)
{
    struct stat about;
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
        return fail(error, LAM_CANNOT_READ, "%s: not a regular file", path);
    return file_read(path, source->pool, source->call, out, error);
}

static bool confine_or_fail(const struct import_source *source, const char *name, char confined[PATH_CAPACITY],
                            lam_error *error)
{
    if (!confine(name, confined, PATH_CAPACITY) || !*confined || strcmp(confined, "..") == 0)
        return fail(error, LAM_CANNOT_READ, "%s: names the file '%.80s', which is not a valid name", source->name,
                    name);
    return true;
}

bool companion_open(const struct import_source *source, const char *name, struct file_bytes *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char confined[PATH_CAPACITY], path[2 * PATH_CAPACITY];
    if (!confine_or_fail(source, name, confined, error))
        return false;
    if (companions->open || !companions->model)
        return open_by_caller(source, confined, out, error);
    return path_beside_model(source, confined, path, error) && read_regular(source, path, out, error);
}

bool companion_open_model(const struct import_source *source, const char *name, struct arena *arena, const char **path,
                          struct file_bytes *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char confined[PATH_CAPACITY], at[2 * PATH_CAPACITY];
    *path = NULL;
    if (!source->params->models_anywhere || companions->open || !companions->model) {
        if (!confine_or_fail(source, name, confined, error))
            return false;
        if (companions->open || !companions->model)
            return open_by_caller(source, confined, out, error);
        name = confined;
    }
    if (!path_beside_model(source, name, at, error))
        return false;
    *path = arena_string(arena, at);
    if (!*path)
        return call_memory_error(source->call, strlen(at), error);
    return read_regular(source, at, out, error);
}
