// file_write.c: writes whole files, so that a reader sees either the old file or the new one, and no temporary file
// remains.
//
// If the file system supports it, the bytes are written to an unnamed file (O_TMPFILE), which the kernel removes when
// the process ends for any reason. The finished file is linked to its name. If that name exists, the file is linked to
// a temporary name and renamed over the old file. All signals are blocked between the link and the rename. SIGKILL
// cannot be blocked, but leaves a temporary file only if the signal arrives in the few microseconds between the link
// and the rename.
//
// Other file systems (NFS, vfat, some FUSE file systems) need a temporary name from the start. Signals are blocked
// while the temporary file exists, but are checked after each chunk. The file is removed before a fatal signal takes
// effect.
#include "file.h"

#include "fail.h"

#include <lambent/path.h>

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { CHUNK = 1 << 20 };

static bool fail_writing(lam_error *error, const char *path, const char *action)
{
    int reason = errno;
    char buffer[PATH_REASON_SIZE];
    const char *text = path_reason(reason, buffer);
    return fail(error, LAM_CANNOT_WRITE, "%s: cannot %s: %s", path, action, text);
}

// --- signals

// Returns whether the process ignores a signal, explicitly or by default.
static bool is_ignored(int number, const struct sigaction *action)
{
    if (action->sa_handler == SIG_IGN)
        return true;
    return action->sa_handler == SIG_DFL &&
           (number == SIGCHLD || number == SIGURG || number == SIGWINCH || number == SIGCONT || number == SIGTSTP ||
            number == SIGTTIN || number == SIGTTOU);
}

// Lets the program's signal handlers run for pending signals. Returns false if a fatal signal is pending.
static bool deliver_handled(const sigset_t *before)
{
    sigset_t pending;
    if (sigpending(&pending) != 0)
        return true;
    for (int number = 1; number < NSIG; number++) {
        struct sigaction action;
        if (sigismember(&pending, number) != 1 || sigismember(before, number) != 0 ||
            sigaction(number, NULL, &action) != 0 || is_ignored(number, &action))
            continue;
        if (action.sa_handler == SIG_DFL)
            return false;
        sigset_t one;
        sigemptyset(&one);
        sigaddset(&one, number);
        pthread_sigmask(SIG_UNBLOCK, &one, NULL);
        pthread_sigmask(SIG_BLOCK, &one, NULL);
    }
    return true;
}

static void hold_signals(sigset_t *before)
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, before);
}

// --- writing

// The data to write and their destination.
struct writing {
    int folder;                  // the folder of the target
    const char *target;          // its name in this folder
    const struct stat *existing; // NULL if the target does not exist
    const void *data;
    size_t size;
    bool durable;
    struct call_control *call;
};

// Returns false and sets errno on failure. The errno ECANCELED means that the call must stop; EINTR means that a fatal
// signal is pending. If file_write has blocked all signals, `before` is the previous set of blocked signals; otherwise
// NULL.
static bool write_all(int file, const struct writing *w, const sigset_t *before)
{
    const uint8_t *at = w->data;
    for (size_t left = w->size; left;) {
        ssize_t wrote = write(file, at, left < CHUNK ? left : CHUNK);
        if (wrote < 0 && errno != EINTR)
            return false;
        at += wrote > 0 ? wrote : 0;
        left -= wrote > 0 ? (size_t)wrote : 0;
        if (before && !deliver_handled(before)) {
            errno = EINTR;
            return false;
        }
        if (!call_should_continue(w->call)) {
            errno = ECANCELED;
            return false;
        }
    }
    return true;
}

// Returns whether the file system, or the device, does not know the last call.
static bool is_unsupported(void) { return errno == EINVAL || errno == ENOSYS || errno == EOPNOTSUPP || errno == EPERM; }

// Flushes the file to disk.
static bool sync_file(int file) { return fsync(file) == 0 || is_unsupported(); }

static bool fill(int file, const struct writing *w, const sigset_t *before)
{
    if (!write_all(file, w, before))
        return false;
    // Keeps the read and write permissions of the existing file, but removes the execute permission: the new file is
    // never a program.
    if (w->existing && fchmod(file, w->existing->st_mode & 0666) != 0 && !is_unsupported())
        return false;
    if (w->durable && !sync_file(file))
        return false;
    // Some file systems report errors only on close. These errors are found by closing a duplicate handle while the
    // file can still be discarded.
    int copy = dup(file);
    return copy < 0 || close(copy) == 0;
}

// Returns an unused hidden file name, allocated with malloc. The name contains the host
// name, because several hosts may write to one folder. Process IDs are not unique; in containers, the ID is often 1.
static char *hidden_name(void)
{
    char *name, host[65] = "";
    if (gethostname(host, sizeof host - 1) != 0 || strchr(host, '/'))
        host[0] = 0;
    return asprintf(&name, ".lambent-%ld-%s-%llx.part", (long)getpid(), host, (unsigned long long)now_ns()) < 0 ? NULL
                                                                                                                : name;
}

// Flushes the folder, which makes the file's name durable.
static bool sync_folder(int parent)
{
    int folder = openat(parent, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    bool ok = folder >= 0 && sync_file(folder);
    lam_path_close(folder);
    return ok;
}

// --- an unnamed file

static bool link_file(int file, int folder, const char *name)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    return linkat(AT_FDCWD, path, folder, name, AT_SYMLINK_FOLLOW) == 0 ||
           (errno != EEXIST && linkat(file, "", folder, name, AT_EMPTY_PATH) == 0); // if /proc is not mounted
}

// Links the file to a temporary name in the folder of the target, and renames it over the target.
static bool link_over(int file, const struct writing *w)
{
    bool ok = false;
    sigset_t before;
    hold_signals(&before);
    for (int attempt = 0; attempt < 100; attempt++) {
        char *name = hidden_name();
        bool linked = name && link_file(file, w->folder, name);
        ok = linked && renameat(w->folder, name, w->folder, w->target) == 0;
        int reason = name ? errno : ENOMEM;
        if (linked && !ok)
            unlinkat(w->folder, name, 0);
        free(name);
        errno = reason;
        if (linked || reason != EEXIST)
            break;
    }
    int reason = errno;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return ok;
}

// Sets *possible to false if the file system does not support unnamed files. In this case, nothing is written.
static bool write_unnamed(const struct writing *w, bool *possible)
{
    int file = openat(w->folder, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    *possible = file >= 0;
    if (file < 0)
        return false;
    bool filled = fill(file, w, NULL), linked = false;
    if (filled)
        linked = (!w->existing && link_file(file, w->folder, w->target)) ||
                 ((w->existing || errno == EEXIST) && link_over(file, w));
    int reason = errno;
    *possible = linked || !filled;
    close(file);
    errno = reason;
    return linked;
}

// --- a named file

// Creates a temporary file in the folder of the target, with the permissions that the umask allows.
static int open_hidden(int folder, char **name)
{
    for (int attempt = 0; attempt < 100; attempt++) {
        *name = hidden_name();
        int file = *name ? openat(folder, *name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
        if (file >= 0)
            return file;
        int reason = *name ? errno : ENOMEM;
        free(*name);
        *name = NULL;
        errno = reason;
        if (reason != EEXIST)
            break;
    }
    return -1;
}

static bool write_named(const struct writing *w)
{
    char *name = NULL;
    sigset_t before;
    hold_signals(&before);
    int file = open_hidden(w->folder, &name);
    bool ok = file >= 0 && fill(file, w, &before);
    int reason = errno;
    if (file >= 0)
        close(file); // fill() has already reported the error
    if (ok && renameat(w->folder, name, w->folder, w->target) != 0) {
        reason = errno;
        ok = false;
    }
    if (file >= 0 && !ok)
        unlinkat(w->folder, name, 0);
    free(name);
    pthread_sigmask(SIG_SETMASK, &before, NULL); // pending signals are delivered here
    errno = reason;
    return ok;
}

// --- writing a file

static bool write_direct(const char *path, const struct writing *w, lam_error *error)
{
    int file = lam_path_open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0)
        return fail_writing(error, path, "open for writing");
    bool ok = write_all(file, w, NULL);
    int reason = errno;
    if (close(file) != 0 && ok) {
        reason = errno;
        ok = false;
    }
    errno = reason;
    if (!ok && reason == ECANCELED)
        return call_error(w->call, error);
    return ok || fail_writing(error, path, "write");
}

bool file_write_by(unsigned way, const char *path, const void *data, size_t size, struct call_control *call,
                   lam_error *error)
{
    struct stat about;
    struct writing w = {.data = data, .size = size, .durable = way & FILE_DURABLE, .call = call};
    // Keeps a symbolic link and replaces the file that it points to, but not if somebody made the link in a held folder.
    bool held = lam_path_held(path) >= 0, ok = false, possible = false;
    char *real = held ? NULL : realpath(path, NULL);
    w.folder = lam_path_parent(real ? real : path, &w.target);
    bool exists = w.folder >= 0 && fstatat(w.folder, w.target, &about, held ? AT_SYMLINK_NOFOLLOW : 0) == 0;
    w.existing = exists ? &about : NULL;
    if (exists && S_ISLNK(about.st_mode)) {
        errno = EMLINK;
    } else if (exists && !S_ISREG(about.st_mode)) {
        lam_path_close(w.folder);
        free(real);
        return S_ISDIR(about.st_mode) ? fail(error, LAM_CANNOT_WRITE, "%s: is a directory, expected a file name", path)
                                      : write_direct(path, &w, error);
    } else if (w.folder >= 0 && (!exists || faccessat(w.folder, w.target, W_OK, 0) == 0)) {
        ok = !(way & FILE_NAMED) && write_unnamed(&w, &possible);
        if (!possible)
            ok = write_named(&w);
        errno = errno == EXDEV ? EOPNOTSUPP : errno; // from renameat: no link leads out, as path_reason would say
        ok = ok && (!w.durable || sync_folder(w.folder));
    }
    lam_path_close(w.folder);
    if (!ok && errno == ECANCELED && !call_should_continue(call))
        call_error(call, error);
    else if (!ok)
        fail_writing(error, path, "write");
    free(real);
    return ok;
}

bool file_write(const char *path, const void *data, size_t size, bool durable, struct call_control *call,
                lam_error *error)
{
    return file_write_by(durable ? FILE_UNNAMED | FILE_DURABLE : FILE_UNNAMED, path, data, size, call, error);
}
