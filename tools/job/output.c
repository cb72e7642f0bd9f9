// output.c: the path of a picture, checks before writing it, and the writing.
#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"

static bool is_folder(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

bool output_is_named(const char *output) { return output && output[strlen(output) - 1] != '/' && !is_folder(output); }

char *output_path(const char *output, const char *model)
{
    if (output_is_named(output))
        return strdup(output);
    const char *folder = output ? output : "", *name = strcmp(model, "-") == 0 ? "model" : model;
    const char *end = name + strlen(name);
    while (end > name && end[-1] == '/') // the model is a folder: loading it reports that
        end--;
    const char *start = end;
    while (start > name && start[-1] != '/')
        start--;
    const char *dot = end;
    while (dot > start && *dot != '.')
        dot--;
    int stem = (int)((dot > start ? dot : end) - start);
    bool slash = *folder && folder[strlen(folder) - 1] != '/';
    char *path = malloc(strlen(folder) + (size_t)stem + sizeof "/model.png");
    if (path)
        sprintf(path, "%s%s%.*s%s.png", folder, slash ? "/" : "", stem, start, stem ? "" : "model");
    return path;
}

static bool check_folder(const char *path, lam_error *error)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
    if (!folder)
        return complain(error, LAM_LIMIT, "out of memory");
    struct stat found;
    bool ok = true;
    if (stat(folder, &found) != 0)
        ok = complain(error, LAM_CANNOT_WRITE, "%s: cannot write: the folder '%s': %s", path, folder, strerror(errno));
    else if (!S_ISDIR(found.st_mode))
        ok = complain(error, LAM_CANNOT_WRITE, "%s: cannot write: '%s' is not a folder", path, folder);
    else if (access(folder, W_OK | X_OK) != 0)
        ok = complain(error, LAM_CANNOT_WRITE, "%s: cannot write: the folder '%s': %s", path, folder, strerror(errno));
    free(folder);
    return ok;
}

bool output_check(const char *path, const char *model, bool named, lam_error *error)
{
    struct stat there, of_model;
    if (stat(path, &there) != 0)
        return check_folder(path, error);
    // The model is itself a picture: loading it reports the real mistake.
    if (!named && stat(model, &of_model) == 0 && there.st_dev == of_model.st_dev && there.st_ino == of_model.st_ino)
        return true;
    if (S_ISDIR(there.st_mode))
        return complain(error, LAM_CANNOT_WRITE, "%s: cannot write: the path is a folder%s", path,
                        named ? "" : "; name another file with -o");
    if (!S_ISREG(there.st_mode)) { // pipes and devices are written directly
        if (access(path, W_OK) != 0)
            return complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(errno));
        return true;
    }
    if (!named && !lam_image_is_from_lambent(path))
        return complain(error, LAM_CANNOT_WRITE,
                        "%s: already exists, and lambent did not write it; -o %s replaces it, -o FILE writes another",
                        path, path);
    return check_folder(path, error);
}

uint64_t output_size(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISREG(found.st_mode) ? (uint64_t)found.st_size : 0;
}

bool output_is_stream(const char *path)
{
    struct stat found;
    lam_pixel_format format;
    return strcmp(path, "-") == 0 || (stat(path, &found) == 0 && !S_ISREG(found.st_mode) && !S_ISDIR(found.st_mode) &&
                                      !lam_image_format_for(path, &format, NULL));
}

bool output_write(const char *path, const lam_bytes *bytes, lam_error *error)
{
    bool to_stdout = strcmp(path, "-") == 0;
    FILE *file = to_stdout ? stdout : fopen(path, "wb");
    bool ok = file && fwrite(bytes->data, 1, bytes->size, file) == bytes->size && fflush(file) == 0;
    if (!ok)
        complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", to_stdout ? "standard output" : path,
                 strerror(errno));
    if (file && !to_stdout)
        fclose(file);
    return ok;
}

bool output_replace(const char *path, const lam_bytes *bytes, lam_error *error)
{
    char *beside = malloc(strlen(path) + sizeof ".XXXXXX");
    if (!beside)
        return complain(error, LAM_LIMIT, "out of memory");
    sprintf(beside, "%s.XXXXXX", path);
    int made = mkstemp(beside);
    FILE *file = made < 0 ? NULL : fdopen(made, "wb");
    bool ok = file && fwrite(bytes->data, 1, bytes->size, file) == bytes->size;
    int reason = errno;
    if (file && fclose(file) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    mode_t mask = umask(0);
    umask(mask);
    if (ok && (chmod(beside, 0666 & ~mask) != 0 || rename(beside, path) != 0)) {
        ok = false;
        reason = errno;
    }
    if (!ok && made >= 0)
        unlink(beside);
    free(beside);
    return ok || complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(reason));
}
