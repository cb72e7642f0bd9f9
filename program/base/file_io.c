// file_io.c: reads and writes open files completely, and opens only regular files.
#include "file_io.h"
#include "console.h"

#include <lambent/path.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

enum { AT_ONCE = 1 << 30 }; // no system writes more than 2 GiB in one call

bool write_all(int file, const void *bytes, size_t size)
{
    for (const char *at = bytes; size;) {
        ssize_t wrote = write(file, at, size < AT_ONCE ? size : AT_ONCE);
        if (wrote < 0 && errno == EAGAIN) // a pipe that its other users have made non-blocking
            poll(&(struct pollfd){.fd = file, .events = POLLOUT}, 1, -1);
        else if (wrote < 0 && errno != EINTR)
            return false;
        at += wrote > 0 ? wrote : 0;
        size -= wrote > 0 ? (size_t)wrote : 0;
    }
    return true;
}

bool read_up_to(int file, char *bytes, size_t size, size_t *length)
{
    ssize_t got = 1;
    for (*length = 0; *length < size && got != 0; *length += got > 0 ? (size_t)got : 0) {
        got = read(file, bytes + *length, size - *length);
        if (got < 0 && errno != EINTR)
            return false;
    }
    return true;
}

bool read_all(int file, void *bytes, size_t size)
{
    size_t length;
    if (!read_up_to(file, bytes, size, &length))
        return false;
    errno = 0;
    return length == size;
}

int open_regular(const char *path, uint64_t *size)
{
    struct stat about;
    if (lam_path_stat(path, &about) != 0)
        return -1;
    int file = S_ISREG(about.st_mode) ? lam_path_open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY) : -1;
    if (file >= 0 && fstat(file, &about) == 0 && !S_ISREG(about.st_mode)) { // the path now leads to another file
        close(file);
        file = -1;
    }
    errno = S_ISREG(about.st_mode) ? errno : 0;
    *size = (uint64_t)about.st_size;
    return file;
}

bool path_is_folder(const char *path)
{
    struct stat found;
    return lam_path_stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

static void close_unless_kept(int file, const int *kept, int count)
{
    struct stat about;
    bool closes = file > STDERR_FILENO && fstat(file, &about) == 0 && !S_ISDIR(about.st_mode);
    for (int i = 0; i < count; i++)
        closes &= file != kept[i];
    if (closes)
        close(file);
}

void close_files(const int *kept, int count)
{
    enum { USUAL = 4096 };
    DIR *list = opendir("/proc/self/fd");
    struct dirent *entry = NULL;
    for (int i = 0; list ? (entry = readdir(list)) != NULL : i < USUAL; i++)
        close_unless_kept(entry ? atoi(entry->d_name) : i, kept, count);
    if (list)
        closedir(list);
}

// --- creates the folder to which a file is written.

char *output_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    while (slash > path && slash[-1] == '/')
        slash--;
    return slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
}

bool output_make_folder(const char *path, lam_error *error)
{
    char *folder = output_folder_of(path);
    if (!folder)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = true;
    for (char *end = folder; ok && *end;) { // starts with the topmost folder
        end += 1 + strcspn(end + 1, "/");
        char kept = *end;
        struct stat found;
        const char *name;
        *end = 0;
        bool missing = lam_path_stat(folder, &found) != 0;
        int parent = missing ? lam_path_parent(folder, &name) : -1;
        if (missing && (parent == -1 || mkdirat(parent, name, 0777) != 0) && errno != EEXIST)
            ok =
                complain(error, LAM_CANNOT_WRITE, "%s: cannot make the folder '%s': %s", path, folder, strerror(errno));
        lam_path_close(parent);
        *end = kept;
    }
    free(folder);
    return ok;
}

// --- finds the folder of this program.

#ifdef __linux__
#include <sys/auxv.h>
#endif

bool own_folder(char folder[PATH_MAX])
{
    ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    folder[length > 0 ? length : 0] = 0;
#ifdef __linux__
    const char *file = (const char *)getauxval(AT_EXECFN);
    if (length <= 0 && (!file || !realpath(file, folder))) // /proc is not mounted
        folder[0] = 0;
#endif
    char *slash = strrchr(folder, '/');
    folder[slash ? slash + 1 - folder : 0] = 0;
    return slash != NULL;
}
