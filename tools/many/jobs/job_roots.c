// job_roots.c: restricts the files of jobs to the folders of --allow-path.
//
// With Landlock, the kernel also restricts a worker to these folders (sandbox_start.c). The check in this file produces
// the error message. Without Landlock, only this check protects files. It is then reliable only if nobody changes links
// in these folders during the check.
#include "job_roots.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "console.h"
#include "file_io.h"

bool job_roots_start(struct job_roots *roots, const struct options *options, lam_error *error)
{
    const struct texts *given = &options->limits.allow_paths;
    *roots = (struct job_roots){.paths = calloc((size_t)given->count + 1, sizeof *roots->paths)};
    if (!roots->paths)
        return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; i < given->count; i++) {
        if (!path_is_folder(given->items[i]))
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--allow-path': found '%.200s', with --jobs expected a folder", given->items[i]);
        char *real = realpath(given->items[i], NULL);
        if (!real)
            return complain(error, LAM_BAD_ARGUMENT, "option '--allow-path': %.200s: %s", given->items[i],
                            strerror(errno));
        roots->paths[roots->count++] = real;
    }
    return true;
}

void job_roots_free(struct job_roots *roots)
{
    for (int i = 0; i < roots->count; i++)
        free(roots->paths[i]);
    free(roots->paths);
    *roots = (struct job_roots){0};
}

static bool is_below(const struct job_roots *roots, const char *real)
{
    bool below = false;
    for (int i = 0; i < roots->count; i++)
        below |= is_in_folder(real, roots->paths[i]);
    return below;
}

// Resolves a path or, if the file does not exist, its nearest existing parent folder. Returns NULL if there is no such
// folder. Also returns NULL if the missing part of the path cannot be created, because it contains ".." or a broken
// link.
static char *resolve(const char *path, bool *exists)
{
    char *real = realpath(path, NULL), *copy = real ? NULL : strdup(path);
    struct stat about;
    *exists = real != NULL;
    while (copy && !real) {
        size_t length = strlen(copy);
        while (length > 1 && copy[length - 1] == '/')
            copy[--length] = 0;
        char *slash = strrchr(copy, '/'), *name = slash ? slash + 1 : copy;
        bool there = lstat(copy, &about) == 0 || (errno != ENOENT && errno != ENOTDIR);
        if (there || strcmp(name, "..") == 0 || strcmp(copy, "/") == 0)
            break;
        bool top = slash == copy;
        if (slash)
            slash[top] = 0;
        real = realpath(slash ? copy : ".", NULL);
        if (!slash)
            break;
    }
    free(copy);
    return real;
}

bool job_roots_have(const struct job_roots *roots, const char *path, bool writes, lam_error *error)
{
    lam_code code = writes ? LAM_CANNOT_WRITE : LAM_CANNOT_READ;
    if (!roots->count)
        return complain(error, code, "%.400s: jobs may not use files; --allow-path DIR allows files below DIR", path);
    bool exists;
    char *real = resolve(path, &exists);
    bool below = real && is_below(roots, real);
    struct stat about;
    bool odd = below && writes && exists && stat(real, &about) == 0 && !S_ISREG(about.st_mode);
    free(real);
    if (odd)
        return complain(error, code, "%.400s: cannot write: is not a regular file", path);
    return below || complain(error, code, "%.400s: is outside the folders that jobs may access (--allow-path)", path);
}
