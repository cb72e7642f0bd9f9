// path.c: holds folders, and opens files below their handles.
#include "fail.h"
#include "file.h"

#include <lambent/path.h>

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { HANDLE = O_PATH | O_CLOEXEC, FOLDER = HANDLE | O_DIRECTORY, WHOLE_SIZE = 3 * PATH_MAX };
enum { IS_LINK = -1, IS_DEVICE = -2 }; // instead of a handle

struct held {
    char *given, *real; // the path as the program writes it, and the absolute path without links
    int folder;         // IS_LINK: only the path is replaced; IS_DEVICE: a link to a pipe, which is opened by its path
    bool links_may_lead_here;
};

static struct {
    struct held *list;
    int count;
    bool refuses_links;
    char here[PATH_MAX]; // the current folder when the first folder was held
} table;

// Returns the end of the list. An empty list has no array, to which nothing may be added, not even 0.
static struct held *held_end(void) { return table.count ? table.list + table.count : table.list; }

// --- paths as text

// Returns the part of `path` after `folder`: "" if both are equal. Returns NULL if the path is not below the folder.
static const char *after(const char *path, const char *folder)
{
    size_t length = strlen(folder);
    bool inside = strncmp(path, folder, length) == 0 &&
                  (!path[length] || path[length] == '/' || (length && folder[length - 1] == '/'));
    return inside ? path + length + strspn(path + length, "/") : NULL;
}

static const char *last_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

// Removes "." and empty components of an absolute path. Each ".." removes the component before it.
static void collapse(char *path)
{
    char *end = path;
    for (const char *at = path; *at;) {
        at += strspn(at, "/");
        size_t length = strcspn(at, "/");
        if (length == 2 && at[0] == '.' && at[1] == '.') {
            while (end > path && *--end != '/')
                continue;
        } else if (length && !(length == 1 && *at == '.')) {
            *end++ = '/';
            memmove(end, at, length);
            end += length;
        }
        at += length;
    }
    *end = 0;
}

// Finds the innermost held folder for a path. Sets `whole` to the absolute path, and *rest to its part below the folder.
// Returns NULL if there is none.
static const struct held *find(const char *path, char whole[WHOLE_SIZE], const char **rest)
{
    const struct held *given = NULL, *best = NULL, *end = held_end();
    for (const struct held *h = table.list; h < end; h++) {
        const char *inside = after(path, h->given);
        if (inside && (h->folder >= 0 || !*inside) && (!given || strlen(h->given) >= strlen(given->given)))
            given = h;
    }
    const char *folder = given ? given->real : *path == '/' ? "" : table.here;
    int length = snprintf(whole, WHOLE_SIZE, "%s/%s", folder, given ? after(path, given->given) : path);
    if (length >= WHOLE_SIZE || (given ? given->folder == IS_DEVICE : *path != '/' && !*folder))
        return NULL;
    collapse(whole);
    for (const struct held *h = table.list; h < end; h++) {
        const char *inside = h->folder < 0 ? NULL : after(whole, h->real);
        if (inside && (!best || strlen(h->real) > strlen(best->real))) {
            best = h;
            *rest = *inside ? inside : ".";
        }
    }
    return best;
}

bool lam_path_is_below(const char *path, const char *folder)
{
    char whole[WHOLE_SIZE], top[WHOLE_SIZE];
    const char *rest;
    return find(path, whole, &rest) && find(folder, top, &rest) && after(whole, top);
}

int lam_path_held(const char *path)
{
    char whole[WHOLE_SIZE];
    const char *rest;
    const struct held *held = find(path, whole, &rest);
    return held ? held->folder : -1;
}

// --- opening

// Like below(), on kernels without openat2.
static int walk(int folder, const char *rest, int flags)
{
    for (int at = folder;;) {
        char name[PATH_MAX];
        size_t length = strcspn(rest, "/");
        bool last = !rest[length];
        struct stat about;
        snprintf(name, sizeof name, "%.*s", (int)length, rest);
        int next = openat(at, name, O_NOFOLLOW | (last ? flags : FOLDER), 0666), reason = errno;
        // O_PATH opens a link itself, and O_DIRECTORY reports a link as ENOTDIR.
        bool exists = (next < 0 ? fstatat(at, name, &about, AT_SYMLINK_NOFOLLOW) : fstat(next, &about)) == 0;
        if (exists && S_ISLNK(about.st_mode)) {
            lam_path_close(next);
            next = -1;
            reason = ELOOP;
        }
        if (at != folder)
            close(at);
        errno = reason;
        if (last || next < 0)
            return next;
        at = next;
        rest += length + 1;
    }
}

// Opens a file below an open folder, and follows no link.
static int below(int folder, const char *rest, int flags)
{
#ifdef SYS_openat2
    const bool makes = flags & (O_CREAT | (O_TMPFILE & ~O_DIRECTORY));
    const struct {
        uint64_t flags, mode, resolve;
    } how = {(uint64_t)flags, makes ? 0666 : 0, 0x02 | 0x04 | 0x08}; // RESOLVE_NO_MAGICLINKS, _NO_SYMLINKS, _BENEATH
    int file = (int)syscall(SYS_openat2, folder, rest, &how, sizeof how);
    if (file >= 0 || (errno != ENOSYS && errno != EPERM))
        return file;
#endif
    return walk(folder, rest, flags);
}

// Opens a path. Sets `whole` to the path of the file without links, if a held folder contains it, otherwise to "".
static int open_whole(const char *path, int flags, char whole[WHOLE_SIZE])
{
    char real[PATH_MAX];
    const char *rest;
    const struct held *held = find(path, whole, &rest), *other;
    if (!held) {
        *whole = 0;
        return open(path, flags, 0666);
    }
    int file = below(held->folder, rest, flags);
    if (file >= 0 || errno != ELOOP || (!table.refuses_links && !realpath(path, real)))
        return file;
    errno = table.refuses_links ? EMLINK : EXDEV;
    other = table.refuses_links ? NULL : find(real, whole, &rest);
    return other && (after(other->real, held->real) || other->links_may_lead_here) ? below(other->folder, rest, flags)
                                                                                   : -1;
}

int lam_path_open(const char *path, int flags)
{
    char whole[WHOLE_SIZE];
    return open_whole(path, flags, whole);
}

int lam_path_stat(const char *path, struct stat *about)
{
    int file = lam_path_open(path, HANDLE), found = file < 0 ? -1 : fstat(file, about);
    lam_path_close(file);
    return found;
}

char *path_real(const char *path)
{
    char whole[WHOLE_SIZE];
    int file = open_whole(path, HANDLE, whole);
    lam_path_close(file);
    return !*whole ? realpath(path, NULL) : file < 0 ? NULL : strdup(whole);
}

int path_open_in(const char *path, size_t folder, int flags)
{
    char top[WHOLE_SIZE];
    snprintf(top, sizeof top, "%.*s", (int)folder, path);
    int handle = lam_path_open(top, FOLDER), file = handle < 0 ? -1 : below(handle, path + folder, flags);
    errno = handle >= 0 && file < 0 && errno == ELOOP ? EMLINK : errno;
    lam_path_close(handle);
    return file;
}

int lam_path_parent(const char *path, const char **name)
{
    char folder[WHOLE_SIZE];
    for (const struct held *h = table.list; h < held_end(); h++)
        if (h->folder == IS_LINK && strcmp(h->given, path) == 0)
            path = h->real;
    *name = last_of(path);
    snprintf(folder, sizeof folder, "%.*s.", (int)(*name - path), path);
    return lam_path_open(folder, FOLDER);
}

void lam_path_close(int folder)
{
    int reason = errno;
    if (folder >= 0)
        close(folder);
    errno = reason;
}

DIR *lam_path_list(const char *path)
{
    int folder = lam_path_open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = folder < 0 ? NULL : fdopendir(folder);
    if (!list)
        lam_path_close(folder);
    return list;
}

// --- holding

void lam_path_refuse_links(void) { table.refuses_links = true; }

// Adds an entry. Takes the ownership of `real`.
static bool add(const char *given, char *real, int folder, bool links_may_lead_here)
{
    struct held *more = realloc(table.list, (size_t)(table.count + 1) * sizeof *more);
    table.list = more ? more : table.list;
    char *copy = strdup(given);
    if (!more || !copy || !real) {
        free(copy);
        free(real);
        return false;
    }
    more[table.count++] = (struct held){copy, real, folder, links_may_lead_here};
    return true;
}

// Replaces the path by the path of its folder. Returns false if there is none.
static bool cut(char path[PATH_MAX])
{
    char *slash = strrchr(path, '/');
    if (strcmp(path, "/") == 0 || strcmp(path, ".") == 0)
        return false;
    if (slash)
        slash[slash == path] = 0;
    else
        strcpy(path, ".");
    return true;
}

// Holds a folder that exists.
static bool hold_folder(char folder[PATH_MAX], bool links_may_lead_here)
{
    enum { OWN = 256 }; // more folders than these share the handle of the topmost folder of their path
    char whole[WHOLE_SIZE];
    const char *rest;
    const struct held *held = find(folder, whole, &rest);
    int handle = held ? below(held->folder, rest, FOLDER) : -1;
    if (table.count >= OWN && handle >= 0 && !links_may_lead_here) {
        close(handle);
        return true;
    }
    for (char *slash; table.count >= OWN && handle < 0 && (slash = strrchr(folder + 1, '/'));)
        *slash = 0;
    if (table.count >= OWN && handle < 0 && *folder != '/')
        strcpy(folder, ".");
    char *real = handle >= 0 ? strdup(whole) : realpath(folder, NULL);
    if (real && strcmp(real, "/") == 0)
        *real = 0;
    for (struct held *h = table.list; real && h < held_end(); h++)
        if (h->folder >= 0 && strcmp(h->real, real) == 0) { // also under another name
            lam_path_close(handle == h->folder ? -1 : handle);
            handle = h->folder;
            h->links_may_lead_here |= links_may_lead_here;
        }
    handle = handle < 0 ? open(folder, FOLDER) : handle;
    return handle >= 0 && add(folder, real, handle, links_may_lead_here);
}

// Notes where a link to a file leads. The file need not exist, but its folder must.
static bool hold_link(const char *path, bool exists, bool is_regular, lam_error *error)
{
    char link[PATH_MAX] = "", target[2 * PATH_MAX], whole[WHOLE_SIZE];
    const char *rest;
    if (exists && !is_regular)
        return add(path, strdup(path), IS_DEVICE, false);
    char *real = realpath(path, NULL);
    if (!real && errno == ENOENT && readlink(path, link, sizeof link - 1) <= 0)
        return false;
    snprintf(target, sizeof target, "%.*s%s", *link == '/' || real ? 0 : (int)(last_of(path) - path), path,
             real ? real : link);
    free(real);
    return lam_path_hold(target, false, error) && find(target, whole, &rest) &&
           add(path, strdup(whole), IS_LINK, false);
}

bool lam_path_hold(const char *path, bool links_may_lead_here, lam_error *error)
{
    struct stat about, own;
    char folder[PATH_MAX];
    bool exists = stat(path, &about) == 0, is_link = lstat(path, &own) == 0 && S_ISLNK(own.st_mode);
    if (!*table.here && !getcwd(table.here, sizeof table.here))
        *table.here = 0;
    snprintf(folder, sizeof folder, "%s", path);
    for (size_t length = strlen(folder); length > 1 && folder[length - 1] == '/';)
        folder[--length] = 0;
    bool ok = !is_link || (exists ? S_ISDIR(about.st_mode) : errno == ELOOP) ||
              hold_link(path, exists, exists && S_ISREG(about.st_mode), error);
    while (ok && (stat(folder, &about) != 0 || !S_ISDIR(about.st_mode)))
        if (!cut(folder))
            return true; // nothing in this path can be exchanged
    if (ok && hold_folder(folder, links_may_lead_here))
        return true;
    int reason = errno;
    char buffer[128];
    return fail(error, LAM_MACHINE, "%s: cannot hold the folder: %s", path, strerror_r(reason, buffer, sizeof buffer));
}
