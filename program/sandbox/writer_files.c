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

#include <lambent/path.h>

#include "console.h"
#include "file_io.h"

#ifdef __wasm__ // wasi-libc lacks fchmod, and files in a web page have no permissions
#define fchmod(file, mode) 0
#endif

enum { STAGED_MAX = 8192 };

// --- checks

bool writer_files_check(const char *path, enum writer_right right, lam_error *error)
{
    struct stat there;
    const char *name;
    int folder = lam_path_parent(path, &name), found = fstatat(folder, name, &there, AT_SYMLINK_NOFOLLOW);
    lam_path_close(folder);
    if (found != 0)
        return true; // writing reports why the folder cannot be opened
    if (S_ISLNK(there.st_mode))
        return complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: %.200s is a link, and lambent chose this name",
                        path, path);
    if (!S_ISREG(there.st_mode))
        return complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: is not a regular file", path);
    return right != WRITER_NEW || complain(error, LAM_CANNOT_WRITE,
                                           "%.400s: cannot write: already exists, and lambent did not write it", path);
}

bool writer_files_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error)
{
    return output_make_folder(path, error) &&
           (durable ? lam_bytes_save_durably(bytes, path, error) : lam_bytes_save(bytes, path, error));
}

// --- sets of files

static struct {
    struct staged {
        int folder;
        char *hidden, *name, *path; // allocated with malloc; the hidden file and the target are in `folder`
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

static void free_staged(struct staged *staged)
{
    lam_path_close(staged->folder);
    free(staged->hidden);
    free(staged->name);
    free(staged->path);
}

// Writes the contents to a new hidden file beside the target. The new file has the target's permissions to read and
// write, as in lam_bytes_save.
static bool fill_hidden(struct staged *staged, const lam_bytes *bytes)
{
    int file = -1;
    struct stat there;
    bool exists = fstatat(staged->folder, staged->name, &there, 0) == 0;
    if (exists && faccessat(staged->folder, staged->name, W_OK, 0) != 0)
        return false;
    for (unsigned attempt = 0; file < 0 && attempt < 100; attempt++) {
        free(staged->hidden);
        const char *slash = strrchr(staged->name, '/'); // on systems where the folder has no handle
        if (asprintf(&staged->hidden, "%.*s.lambent-%ld-%zu-%u.part", slash ? (int)(slash + 1 - staged->name) : 0,
                     staged->name, (long)getpid(), set.count, attempt) < 0)
            staged->hidden = NULL;
        file =
            staged->hidden ? openat(staged->folder, staged->hidden, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
        if (file < 0 && (!staged->hidden || errno != EEXIST))
            return false;
    }
    bool ok = file >= 0 && write_all(file, bytes->data, bytes->size) &&
              (!exists || fchmod(file, there.st_mode & 0666) == 0 || errno == EPERM || errno == ENOSYS ||
               errno == EOPNOTSUPP);
    int reason = errno;
    if (file >= 0 && close(file) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    if (file >= 0 && !ok)
        unlinkat(staged->folder, staged->hidden, 0);
    errno = reason;
    return ok;
}

bool writer_files_stage(const char *path, const lam_bytes *bytes, lam_error *error)
{
    const char *name;
    struct staged staged = {.folder = lam_path_parent(path, &name), .path = strdup(path)};
    staged.name = staged.folder == -1 ? NULL : strdup(name);
    lock_set();
    bool ok =
        set.count < STAGED_MAX || complain(error, LAM_LIMIT, "%.400s: is one of more than %d files", path, STAGED_MAX);
    ok = ok && ((staged.path && staged.name && fill_hidden(&staged, bytes)) || fail_writing(path, error));
    if (ok)
        set.files[set.count++] = staged;
    unlock_set();
    if (!ok)
        free_staged(&staged);
    return ok;
}

// Ends the set. If `renames` is set, gives the hidden files their final names; otherwise, removes the hidden files.
static bool finish(bool renames, lam_error *error)
{
    lock_set();
    bool ok = true;
    for (size_t i = 0; i < set.count; i++) {
        struct staged *staged = &set.files[i];
        if (renames && ok && renameat(staged->folder, staged->hidden, staged->folder, staged->name) != 0)
            ok = fail_writing(staged->path, error);
        if (!renames || !ok)
            unlinkat(staged->folder, staged->hidden, 0);
        free_staged(staged);
    }
    set.count = 0;
    unlock_set();
    return ok;
}

bool writer_files_commit(lam_error *error) { return finish(true, error); }

void writer_files_drop(void) { finish(false, NULL); }

void writer_files_remove(const char *path)
{
    const char *name;
    int folder = lam_path_parent(path, &name);
    if (folder != -1)
        unlinkat(folder, name, 0);
    lam_path_close(folder);
}
