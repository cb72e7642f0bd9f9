// writer_files.c: checks paths before the writer replaces them, and replaces sets of files.
#include "writer.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"
#include "file_io.h"
#include "output_folder.h"

#ifdef __wasm__ // wasi-libc lacks chmod, and files in a web page have no permissions
#define chmod(path, mode) 0
#endif

enum { STAGED_MAX = 8192 };

// --- checks

bool writer_check_links(const char *path, size_t named, lam_error *error)
{
    char *copy = strdup(path);
    bool ok = copy || complain(error, LAM_MACHINE, "out of memory");
    for (char *end = ok ? copy + named : NULL; ok && *end;) {
        struct stat found;
        end += 1 + strcspn(end + 1, "/");
        char kept = *end;
        *end = 0;
        if (lstat(copy, &found) == 0 && S_ISLNK(found.st_mode))
            ok = complain(error, LAM_CANNOT_WRITE,
                          "%.400s: cannot write: %.200s is a link, and lambent chose this name", path, copy);
        *end = kept;
    }
    free(copy);
    return ok;
}

bool writer_files_check(const char *path, enum writer_right right, lam_error *error)
{
    struct stat there;
    const char *slash = strrchr(path, '/');
    if (right & WRITER_IMPLIED && !writer_check_links(path, slash ? (size_t)(slash - path) : 0, error))
        return false;
    bool exists = stat(path, &there) == 0;
    if (exists && !S_ISREG(there.st_mode))
        return complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: is not a regular file", path);
    return !exists || (right & ~WRITER_IMPLIED) != WRITER_NEW ||
           complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: already exists, and lambent did not write it",
                    path);
}

bool writer_files_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error)
{
    return output_make_folder(path, error) &&
           (durable ? lam_bytes_save_durably(bytes, path, error) : lam_bytes_save(bytes, path, error));
}

// --- sets of files

static struct {
    struct staged {
        char *hidden, *target; // allocated with malloc
    } files[STAGED_MAX];
    size_t count;
    bool locked; // accessed atomically; threads of the writer rarely wait for this lock
} set;

static void lock_set(void)
{
    while (__atomic_exchange_n(&set.locked, true, __ATOMIC_ACQUIRE))
        sched_yield();
}

static void unlock_set(void) { __atomic_store_n(&set.locked, false, __ATOMIC_RELEASE); }

static bool fail_writing(const char *path, lam_error *error)
{
    return complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: %s", path, strerror(errno));
}

// Writes the contents to a new hidden file beside the target. The new file has the target's permissions to read and
// write, as in lam_bytes_save.
static bool fill_hidden(struct staged *staged, const lam_bytes *bytes)
{
    const char *slash = strrchr(staged->target, '/');
    int file = -1, folder = slash ? (int)(slash + 1 - staged->target) : 0;
    struct stat there;
    bool exists = stat(staged->target, &there) == 0;
    if (exists && access(staged->target, W_OK) != 0)
        return false;
    for (unsigned attempt = 0; file < 0 && attempt < 100; attempt++) {
        free(staged->hidden);
        if (asprintf(&staged->hidden, "%.*s.lambent-%ld-%zu-%u.part", folder, staged->target, (long)getpid(), set.count,
                     attempt) < 0)
            staged->hidden = NULL;
        file = staged->hidden ? open(staged->hidden, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
        if (file < 0 && (!staged->hidden || errno != EEXIST))
            return false;
    }
    bool ok = file >= 0 && write_all(file, bytes->data, bytes->size) &&
              (!exists || chmod(staged->hidden, there.st_mode & 0666) == 0 || errno == EPERM);
    int reason = errno;
    if (file >= 0 && close(file) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    if (file >= 0 && !ok)
        unlink(staged->hidden);
    errno = reason;
    return ok;
}

bool writer_files_stage(const char *path, const lam_bytes *bytes, lam_error *error)
{
    struct stat there;
    struct staged staged = {.target = stat(path, &there) == 0 ? realpath(path, NULL) : strdup(path)};
    lock_set();
    bool ok =
        set.count < STAGED_MAX || complain(error, LAM_LIMIT, "%.400s: is one of more than %d files", path, STAGED_MAX);
    ok = ok && ((staged.target && fill_hidden(&staged, bytes)) || fail_writing(path, error));
    if (ok)
        set.files[set.count++] = staged;
    unlock_set();
    if (!ok) {
        free(staged.hidden);
        free(staged.target);
    }
    return ok;
}

// Ends the set. If `renames` is set, gives the hidden files their final names; otherwise, removes the hidden files.
static bool finish(bool renames, lam_error *error)
{
    lock_set();
    bool ok = true;
    for (size_t i = 0; i < set.count; i++) {
        struct staged *staged = &set.files[i];
        if (renames && ok && rename(staged->hidden, staged->target) != 0)
            ok = fail_writing(staged->target, error);
        if (!renames || !ok)
            unlink(staged->hidden);
        free(staged->hidden);
        free(staged->target);
    }
    set.count = 0;
    unlock_set();
    return ok;
}

bool writer_files_commit(lam_error *error) { return finish(true, error); }

void writer_files_drop(void) { finish(false, NULL); }
