// file_write_web.c: writes whole files on WebAssembly. The host provides the file system; a web page keeps its files in
// memory. No signal can interrupt a write, so the precautions of file_write.c are not needed.
#include "file.h"

#include "fail.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { CHUNK = 1 << 20 };

static bool write_all(int file, const uint8_t *at, size_t left, struct call_control *call)
{
    while (left) {
        ssize_t wrote = write(file, at, left < CHUNK ? left : CHUNK);
        if (wrote < 0 && errno != EINTR)
            return false;
        at += wrote > 0 ? wrote : 0;
        left -= wrote > 0 ? (size_t)wrote : 0;
        if (!call_should_continue(call)) {
            errno = ECANCELED;
            return false;
        }
    }
    return true;
}

bool file_write_by(unsigned way, const char *path, const void *data, size_t size, struct call_control *call,
                   lam_error *error)
{
    (void)way;
    struct stat about;
    bool exists = stat(path, &about) == 0;
    if (exists && S_ISDIR(about.st_mode))
        return fail(error, LAM_CANNOT_WRITE, "%s: is a directory, expected a file name", path);
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    bool ok = file >= 0 && write_all(file, data, size, call);
    int reason = errno;
    if (file >= 0)
        close(file);
    if (ok)
        return true;
    if (file >= 0)
        unlink(path);
    if (reason == ECANCELED && !call_should_continue(call))
        return call_error(call, error);
    return fail(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(reason));
}

bool file_write(const char *path, const void *data, size_t size, bool durable, struct call_control *call,
                lam_error *error)
{
    return file_write_by(durable ? FILE_DURABLE : FILE_UNNAMED, path, data, size, call, error);
}
