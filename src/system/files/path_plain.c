// path_plain.c: the functions of path.h on Windows and WebAssembly, which open files by their paths. A check of the
// resolved path keeps jobs in their folders.
#include "fail.h"
#include "file.h"

#include <lambent/path.h>

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool lam_path_hold(const char *path, bool links_may_lead_here, lam_error *error)
{
    (void)path, (void)links_may_lead_here, (void)error;
    return true;
}

void lam_path_refuse_links(void) {}

bool lam_path_is_below(const char *path, const char *folder)
{
    const char *slash = strrchr(path, '/');
    char *parent = slash ? strndup(path, (size_t)(slash + 1 - path)) : strdup(".");
    char *real = realpath(path, NULL), *top = realpath(folder, NULL);
    real = real || !parent ? real : realpath(parent, NULL); // the file need not exist
    size_t length = top ? strlen(top) : 0;
    bool below = real && top && strncmp(real, top, length) == 0 &&
                 (!real[length] || real[length] == '/' || top[length - 1] == '/');
    free(parent);
    free(real);
    free(top);
    return below;
}

int lam_path_held(const char *path)
{
    (void)path;
    return -1;
}

int lam_path_open(const char *path, int flags) { return open(path, flags, 0666); }

int lam_path_stat(const char *path, struct stat *about) { return stat(path, about); }

char *path_real(const char *path) { return realpath(path, NULL); }

int path_open_in(const char *path, size_t folder, int flags)
{
    (void)folder;
    return open(path, flags | O_NOFOLLOW);
}

int lam_path_parent(const char *path, const char **name)
{
    *name = path;
    return AT_FDCWD;
}

void lam_path_close(int folder) { (void)folder; }

DIR *lam_path_list(const char *path) { return opendir(path); }
