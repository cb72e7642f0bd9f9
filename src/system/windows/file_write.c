// file_write.c: writes whole files on Windows, so that a reader sees either the old file or the new one. The
// function writes the bytes to a temporary file in the same folder, and then renames the temporary file.
#include "file.h"

#include "fail.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = 1 << 20 };

// Returns false and sets errno on failure; ECANCELED means that the call must stop.
static bool write_all(int file, const uint8_t *at, size_t left, struct call_control *call)
{
    while (left) {
        ssize_t wrote = write(file, at, left < BLOCK ? (unsigned)left : BLOCK);
        if (wrote < 0)
            return false;
        at += wrote;
        left -= (size_t)wrote;
        if (!call_should_continue(call)) {
            errno = ECANCELED;
            return false;
        }
    }
    return true;
}

// Writes the data to `name`, which is a new file or a device. Removes the file if writing fails and `is_new` is true.
static bool write_to(const char *name, bool is_new, const void *data, size_t size, bool durable,
                     struct call_control *call)
{
    int file = open(name, O_WRONLY | O_CLOEXEC | (is_new ? O_CREAT | O_EXCL : 0), 0666);
    bool ok = file >= 0 && write_all(file, data, size, call) && (!durable || !is_new || fsync(file) == 0);
    int reason = errno;
    if (file >= 0 && close(file) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    if (file >= 0 && !ok && is_new)
        unlink(name);
    errno = reason;
    return ok;
}

static bool write_beside(const char *target, const void *data, size_t size, bool durable, struct call_control *call)
{
    char *name;
    int folder = (int)(path_name(target) - target);
    if (asprintf(&name, "%.*s.lambent-%ld-%llx.part", folder, target, (long)getpid(), (unsigned long long)now_ns()) <
        0) {
        errno = ENOMEM;
        return false;
    }
    bool written = write_to(name, true, data, size, durable, call), ok = written && rename(name, target) == 0;
    int reason = errno;
    if (written && !ok)
        unlink(name);
    free(name);
    errno = reason;
    return ok;
}

bool file_write_by(unsigned way, const char *path, const void *data, size_t size, struct call_control *call,
                   lam_error *error)
{
    struct stat about;
    bool exists = stat(path, &about) == 0, durable = way & FILE_DURABLE;
    if (exists && S_ISDIR(about.st_mode))
        return fail(error, LAM_CANNOT_WRITE, "%s: is a directory, expected a file name", path);
    char *target = exists && S_ISREG(about.st_mode) ? realpath(path, NULL) : strdup(path);
    bool ok = target && (!exists || access(path, W_OK) == 0) &&
              (exists && !S_ISREG(about.st_mode) ? write_to(path, false, data, size, false, call)
                                                 : write_beside(target, data, size, durable, call));
    int reason = target ? errno : ENOMEM;
    free(target);
    if (ok)
        return true;
    if (reason == ECANCELED && !call_should_continue(call))
        return call_error(call, error);
    return fail(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(reason));
}

bool file_write(const char *path, const void *data, size_t size, bool durable, struct call_control *call,
                lam_error *error)
{
    return file_write_by(durable ? FILE_UNNAMED | FILE_DURABLE : FILE_UNNAMED, path, data, size, call, error);
}
