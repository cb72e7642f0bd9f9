// page_file.c: finds the page and reads whole files.
#include "page_file.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "console.h"
#include "file_io.h"

#ifndef LAMBENT_DATADIR // Meson's datadir
#define LAMBENT_DATADIR "share"
#endif

bool page_is_named(const char *output)
{
    size_t length = output ? strlen(output) : 0;
    return length > 5 && strcasecmp(output + length - 5, ".html") == 0;
}

// Reports that the page is missing. For a program in a build folder, the error names the command that makes the page.
static void fail_missing(const char *program, size_t folder, lam_error *error)
{
    char path[PATH_MAX + 100], *sources = NULL;
    snprintf(path, sizeof path, "%.*s../web/build.py", (int)folder, program);
    if (access(path, R_OK) == 0) {
        path[strlen(path) - strlen("/web/build.py")] = 0;
        sources = realpath(path, NULL);
    }
    if (sources)
        complain(error, LAM_UNSUPPORTED,
                 "the page, lambent.html, is not built yet; this command builds it in about two minutes: make -C "
                 "'%.300s' web",
                 sources);
    else
        complain(error, LAM_UNSUPPORTED,
                 "the page, lambent.html, is not installed; `make web install` in the folder of Lambent's sources "
                 "builds and installs it (or set LAMBENT_PAGE to its path)");
    free(sources);
}

char *page_file_find(lam_error *error)
{
    const char *named = getenv("LAMBENT_PAGE");
    char own[PATH_MAX], path[PATH_MAX + 100];
    char *found = NULL;
    if (named && *named) {
        found = strdup(named);
        if (!found)
            complain(error, LAM_MACHINE, "out of memory");
        return found;
    }
    // Relative to the program's folder: the installed page, and the page of a build folder.
    static const char *const places[] = {"../" LAMBENT_DATADIR "/lambent/lambent.html", "../build-web/lambent.html"};
    ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    own[length > 0 ? length : 0] = 0;
    char *slash = strrchr(own, '/');
    for (size_t i = 0; slash && i < sizeof places / sizeof *places; i++) {
        snprintf(path, sizeof path, "%.*s%s", (int)(slash + 1 - own), own, places[i]);
        if (access(path, R_OK) != 0)
            continue;
        found = strdup(path);
        if (!found)
            complain(error, LAM_MACHINE, "out of memory");
        return found;
    }
    fail_missing(own, slash ? (size_t)(slash + 1 - own) : 0, error);
    return NULL;
}

char *page_file_read(const char *path, size_t most, size_t *size, lam_error *error)
{
    uint64_t length = 0;
    *size = 0;
    int file = open_regular(path, &length);
    char *bytes = NULL;
    if (file < 0) {
        complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", path,
                 errno ? strerror(errno) : "is not a regular file");
    } else if (length > most) {
        *size = (size_t)length;
        complain(error, LAM_LIMIT, "%s: has %.1f MB, more than the %.1f MB that fit", path, (double)length / 1e6,
                 (double)most / 1e6);
    } else if (!(bytes = malloc((size_t)length + 1))) {
        complain(error, LAM_MACHINE, "out of memory");
    } else if (!read_all(file, bytes, (size_t)length)) {
        complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", path,
                 errno ? strerror(errno) : "the file has become shorter");
        free(bytes);
        bytes = NULL;
    } else {
        *size = (size_t)length;
        bytes[*size] = 0;
    }
    if (file >= 0)
        close(file);
    return bytes;
}
