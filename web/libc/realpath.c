// realpath.c: the absolute path of a file. The files of a module are a tree without links (web/wasi.js), whose current
// folder is the root.
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char *realpath(const char *path, char *buffer)
{
    size_t length = strlen(path);
    if (access(path, F_OK) != 0)
        return NULL;
    if (buffer && length + 2 > PATH_MAX) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    char *real = buffer ? buffer : malloc(length + 2), *end = real;
    if (!real)
        return NULL;
    for (const char *at = path; *at;) {
        length = strcspn(at, "/");
        if (length == 2 && at[0] == '.' && at[1] == '.') {
            while (end > real && *--end != '/')
                ;
        } else if (length > 0 && !(length == 1 && at[0] == '.')) {
            *end++ = '/';
            memcpy(end, at, length);
            end += length;
        }
        at += length + (at[length] == '/');
    }
    if (end == real)
        *end++ = '/';
    *end = 0;
    return real;
}
