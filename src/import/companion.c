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
    bool leaves = out[0] == '/' || (out[0] && out[1] == ':');
    for (const char *part = out; *part;) {
        size_t end = strcspn(part, "/");
        leaves |= end == 2 && part[0] == '.' && part[1] == '.';
        part += end;
        part += strspn(part, "/");
    }
    if (leaves) {
        const char *last = path_name(out);
        memmove(out, last, strlen(last) + 1);
    }
    return true;
}

enum { PATH_LONGEST = 4096 };

// Through the caller's function, by the name as it may be looked for.
static bool open_by_caller(const struct import_source *source, const char *inside, struct file_bytes *out,
                           lam_error *error)
{
    const struct companions *companions = source->open_state;
    if (!companions->open)
        return fail(error, LAM_CANNOT_READ, "%s: the file '%s' is not at hand", source->name, inside);
    lam_bytes bytes = {0};
    if (!companions->open(companions->user, inside, &bytes, error))
        return false;
    bool ok = file_copy(bytes.data, bytes.size, source->call, out, error);
    if (companions->release)
        companions->release(companions->user, &bytes);
    else
        lam_bytes_free(&bytes);
    return ok;
}

// The name beside the model, as it can be opened from here.
static bool beside(const struct import_source *source, const char *name, char path[2 * PATH_LONGEST], lam_error *error)
{
    const char *model = ((const struct companions *)source->open_state)->model;
    int folder = name[0] == '/' ? 0 : (int)(path_name(model) - model);
    // Behind "./" a file called "-" is a file.
    int length =
        snprintf(path, 2 * PATH_LONGEST, "%.*s%s%s", folder, model, folder == 0 && name[0] == '-' ? "./" : "", name);
    if (length < 0 || length >= 2 * PATH_LONGEST)
        return fail(error, LAM_CANNOT_READ, "%s: the path to '%.80s' is too long", source->name, name);
    return true;
}

// A pipe or a device of that name would be waited for.
static bool read_regular(const struct import_source *source, const char *path, struct file_bytes *out, lam_error *error)
{
    struct stat about;
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
        return fail(error, LAM_CANNOT_READ, "%s: is not a file", path);
    return file_read(path, source->pool, source->call, out, error);
}

static bool confine_or_fail(const struct import_source *source, const char *name, char inside[PATH_LONGEST],
                            lam_error *error)
{
    if (!confine(name, inside, PATH_LONGEST) || !*inside || strcmp(inside, "..") == 0)
        return fail(error, LAM_CANNOT_READ, "%s: names a file '%.80s' that cannot be looked for", source->name, name);
    return true;
}

bool companion_open(const struct import_source *source, const char *name, struct file_bytes *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char inside[PATH_LONGEST], path[2 * PATH_LONGEST];
    if (!confine_or_fail(source, name, inside, error))
        return false;
    if (companions->open || !companions->model)
        return open_by_caller(source, inside, out, error);
    return beside(source, inside, path, error) && read_regular(source, path, out, error);
}

bool companion_open_model(const struct import_source *source, const char *name, struct arena *arena, const char **path,
                          struct file_bytes *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char inside[PATH_LONGEST], at[2 * PATH_LONGEST];
    *path = NULL;
    if (!source->params->models_anywhere || companions->open || !companions->model) {
        if (!confine_or_fail(source, name, inside, error))
            return false;
        if (companions->open || !companions->model)
            return open_by_caller(source, inside, out, error);
        name = inside;
    }
    if (!beside(source, name, at, error))
        return false;
    *path = arena_string(arena, at);
    if (!*path)
        return call_memory_error(source->call, strlen(at), error);
    return read_regular(source, at, out, error);
}
