// writer.c: implements the writer, the process that writes files for the process in the sandbox.
//
// There is one socket pair for each thread that the writer can serve. A request consists of a header, the path and the
// contents; the answer is a lam_error. The requesting thread blocks signals until the answer arrives, so that a signal
// cannot end the process before the file is complete. If SIGKILL ends the process, the writer finishes the files that
// it has received completely and discards all other files.
#include "writer.h"

#include <stdlib.h>
#include <unistd.h>

#include <lambent/path.h>

#include "console.h"
#include "file_io.h"
#include "sandbox.h"

#ifdef __linux__

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <time.h>

enum { THREADS_MAX = 256, STACK = 256 << 10, OWN_MAX = 65536 };

enum action { SAVE, SAVE_DURABLY, REMOVE, STAGE, COMMIT, DROP };

struct request {
    uint32_t action;
    uint32_t path_size; // including the terminating zero
    uint64_t size;      // the size of the contents; 0 unless the action is to save or stage
};

// Sends everything in one call if possible, so that the receiver wakes only once.
static bool send_all(int to, struct iovec *parts, int count)
{
    while (count) {
        ssize_t sent = writev(to, parts, count);
        if (sent < 0 && errno != EINTR)
            return false;
        size_t left = sent > 0 ? (size_t)sent : 0;
        for (; count && left >= parts->iov_len; parts++, count--)
            left -= parts->iov_len;
        if (count) {
            parts->iov_base = (char *)parts->iov_base + left;
            parts->iov_len -= left;
        }
    }
    return true;
}

// --- the writer

// The identity and modification time of a file that this run wrote in a format without metadata.
struct own_file {
    dev_t device;
    ino_t number;
    struct timespec changed;
};

static struct {
    const struct sandbox_paths *paths;
    uint64_t largest;             // the largest size of the contents; 0 means unlimited
    pthread_mutex_t lock;         // protects the rule and the list
    struct own_file own[OWN_MAX]; // the most recent files; older files are treated like the files of other programs
    size_t own_count;
} writing = {.lock = PTHREAD_MUTEX_INITIALIZER};

static bool own_of(const char *path, struct own_file *own)
{
    struct stat about;
    bool found = lam_path_stat(path, &about) == 0;
    *own = (struct own_file){about.st_dev, about.st_ino, about.st_ctim};
    return found;
}

// Returns whether this run wrote the file and the file has not changed since.
static bool is_of_run(const char *path)
{
    struct own_file file;
    bool found = false;
    if (!own_of(path, &file))
        return false;
    pthread_mutex_lock(&writing.lock);
    for (size_t i = 0; i < writing.own_count && i < OWN_MAX && !found; i++)
        found = writing.own[i].device == file.device && writing.own[i].number == file.number &&
                writing.own[i].changed.tv_sec == file.changed.tv_sec &&
                writing.own[i].changed.tv_nsec == file.changed.tv_nsec;
    pthread_mutex_unlock(&writing.lock);
    return found;
}

static bool is_own(const char *path) { return lam_image_is_from_lambent(path) || is_of_run(path); }

static void note_own(const char *path)
{
    struct own_file file;
    if (!own_of(path, &file))
        return;
    pthread_mutex_lock(&writing.lock);
    writing.own[writing.own_count++ % OWN_MAX] = file;
    pthread_mutex_unlock(&writing.lock);
}

// Returns whether the run may write the file. Called before the contents are received.
static bool may_write(const struct request *request, const char *path, enum writer_right right, lam_error *error)
{
    struct stat there;
    if (right != WRITER_NEW && right != WRITER_NEW_OR_OURS && right != WRITER_ANY)
        return complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: this run may not write the file", path);
    if (!writer_files_check(path, right, error))
        return false;
    if (right == WRITER_NEW_OR_OURS && lam_path_stat(path, &there) == 0 && !is_own(path))
        return complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: already exists, and lambent did not write it",
                        path);
    return !writing.largest || request->size <= writing.largest ||
           complain(error, LAM_LIMIT, "%.400s: the file has %llu bytes, expected at most %llu (--memory-limit)", path,
                    (unsigned long long)request->size, (unsigned long long)writing.largest);
}

static bool save(enum action action, const char *path, const lam_bytes *bytes, enum writer_right right,
                 lam_error *error)
{
    if (action == STAGE)
        return writer_files_stage(path, bytes, error);
    bool ok = writer_files_save(path, bytes, action == SAVE_DURABLY, error);
    if (ok && right == WRITER_NEW_OR_OURS && !lam_image_is_from_lambent(path))
        note_own(path);
    return ok;
}

// Receives and discards contents, so that the requesting process can read the answer.
static bool skip(int from, uint64_t size)
{
    char part[16 << 10];
    for (; size; size -= size < sizeof part ? size : sizeof part)
        if (!read_all(from, part, size < sizeof part ? size : sizeof part))
            return false;
    return true;
}

// Receives the contents and executes the request. Returns false if the requesting process has ended.
static bool act(int connection, const struct request *request, const char *path, lam_error *error)
{
    if (request->action == COMMIT || request->action == DROP) {
        if (request->action == DROP)
            writer_files_drop();
        else
            writer_files_commit(error);
        return skip(connection, request->size);
    }
    pthread_mutex_lock(&writing.lock);
    enum writer_right right = writing.paths->may_write(writing.paths->user, path);
    pthread_mutex_unlock(&writing.lock);
    if (request->action == REMOVE) {
        if (right != WRITER_REMOVES)
            complain(error, LAM_CANNOT_WRITE, "%.400s: cannot remove: this run may not remove the file", path);
        else
            writer_files_remove(path);
        return skip(connection, request->size);
    }
    if (!may_write(request, path, right, error))
        return skip(connection, request->size);
    void *data = malloc(request->size ? request->size : 1);
    if (!data)
        complain(error, LAM_MACHINE, "%.400s: cannot write: out of memory", path);
    bool ok = data ? read_all(connection, data, request->size) : skip(connection, request->size);
    if (ok && data)
        save((enum action)request->action, path, &(lam_bytes){data, request->size}, right, error);
    free(data);
    return ok;
}

// Answers one request. Returns false if the other process has ended or the request is invalid.
static bool answer(int connection)
{
    struct request request;
    char path[PATH_MAX];
    lam_error error = {0};
    if (!read_all(connection, &request, sizeof request) || request.path_size > sizeof path || request.path_size < 2 ||
        request.action > DROP || !read_all(connection, path, request.path_size) || path[request.path_size - 1])
        return false;
    return act(connection, &request, path, &error) && send_all(connection, &(struct iovec){&error, sizeof error}, 1);
}

// Serves `count` connections until all of them are closed.
static void serve(int *connections, int count)
{
    struct pollfd wait[THREADS_MAX];
    while (count) {
        for (int i = 0; i < count; i++)
            wait[i] = (struct pollfd){.fd = connections[i], .events = POLLIN};
        if (poll(wait, (nfds_t)count, -1) < 0)
            continue;
        for (int i = count - 1; i >= 0; i--)
            if (wait[i].revents && !answer(connections[i])) {
                close(connections[i]);
                connections[i] = connections[--count];
            }
    }
}

static void *serve_one(void *user)
{
    int connection = *(int *)user;
    serve(&connection, 1);
    return NULL;
}

static _Noreturn void run(int *connections, int count)
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, NULL);
    prctl(PR_SET_NAME, "lambent-writer");
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    close_files(connections, count);                        // locks, terminals and pipes belong to the other process
    for (int stream = 0; stream <= STDERR_FILENO; stream++) // the writer needs no standard streams
        (void)!open("/dev/null", O_RDWR | O_CLOEXEC);
    sandbox_enter_writer(writing.paths);
    pthread_attr_t small;
    pthread_attr_init(&small);
    pthread_attr_setstacksize(&small, STACK);
    pthread_t threads[THREADS_MAX];
    int own = count; // this thread serves the connections for which no thread could be started
    while (own > 1 && pthread_create(&threads[own - 1], &small, serve_one, &connections[own - 1]) == 0)
        own--;
    serve(connections, own);
    for (int i = own; i < count; i++)
        pthread_join(threads[i], NULL);
    writer_files_drop(); // removes the hidden files of an incomplete set
    _exit(0);
}

// --- the process that it writes for

static struct {
    int connections[THREADS_MAX];
    bool taken[THREADS_MAX];
    int count;
    pid_t process;
    pthread_mutex_t lock;
    pthread_cond_t given;
} writer = {.lock = PTHREAD_MUTEX_INITIALIZER, .given = PTHREAD_COND_INITIALIZER};

// Makes a socket pair with descriptors above 2, because the standard streams may be closed.
static bool make_pair(int *here, int *there)
{
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
        return false;
    *here = fcntl(pair[0], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    *there = fcntl(pair[1], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(pair[0]);
    close(pair[1]);
    if (*here >= 0 && *there >= 0)
        return true;
    if (*here >= 0)
        close(*here);
    if (*there >= 0)
        close(*there);
    return false;
}

bool writer_start(const struct sandbox_paths *paths, uint64_t largest, lam_error *error)
{
    int there[THREADS_MAX];
    int made = 0, count = paths->writers;
    count = count < 1 ? 1 : count < THREADS_MAX ? count : THREADS_MAX;
    while (made < count && make_pair(&writer.connections[made], &there[made]))
        made++; // with fewer connections than threads, the threads take turns
    pid_t process = made ? fork() : -1;
    int reason = errno;
    if (process == 0) {
        for (int i = 0; i < made; i++)
            close(writer.connections[i]);
        writer.count = 0;
        writing.paths = paths;
        writing.largest = largest;
        run(there, made);
    }
    for (int i = 0; i < made; i++)
        close(there[i]);
    writer.count = made;
    writer.process = process;
    if (process > 0)
        return true;
    writer_leave();
    return complain(error, LAM_MACHINE, "cannot start the process that writes files: %s", strerror(reason));
}

bool writer_is_there(void) { return writer.count > 0; }

pid_t writer_process(void) { return writer.count ? writer.process : getpid(); }

void writer_finish(void)
{
    for (int i = 0; i < writer.count; i++)
        close(writer.connections[i]);
    writer.count = 0;
}

pid_t writer_leave(void)
{
    pid_t process = writer.process > 0 ? writer.process : 0;
    writer_finish();
    writer.process = 0;
    return process;
}

void writer_end(void)
{
    pid_t process = writer_leave();
    while (process > 0 && waitpid(process, NULL, 0) < 0 && errno == EINTR)
        continue;
}

static int take(void)
{
    pthread_mutex_lock(&writer.lock);
    for (int i = 0;; i = (i + 1) % writer.count) {
        if (!writer.taken[i]) {
            writer.taken[i] = true;
            pthread_mutex_unlock(&writer.lock);
            return i;
        }
        if (i == writer.count - 1)
            pthread_cond_wait(&writer.given, &writer.lock);
    }
}

static void give(int i)
{
    pthread_mutex_lock(&writer.lock);
    writer.taken[i] = false;
    pthread_cond_signal(&writer.given);
    pthread_mutex_unlock(&writer.lock);
}

static bool ask(enum action action, const char *path, const lam_bytes *bytes, lam_error *error)
{
    struct request request = {action, (uint32_t)strlen(path) + 1, bytes->size};
    struct iovec parts[] = {
        {&request, sizeof request}, {(void *)(uintptr_t)path, request.path_size}, {bytes->data, bytes->size}};
    sigset_t all, pipe, before;
    sigfillset(&all);
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    int i = take(), connection = writer.connections[i];
    bool sent = send_all(connection, parts, 3);
    if (!sent && errno == EPIPE)
        sigtimedwait(&pipe, NULL, &(struct timespec){0});
    bool ok = sent && read_all(connection, error, sizeof *error);
    give(i);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return ok ? !error->code
              : complain(error, LAM_CANNOT_WRITE, "%.400s: cannot write: the process that writes files has ended",
                         path);
}

bool writer_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error)
{
    struct stat there;
    // The process in the sandbox itself opens the pipes and devices that the user names. The writer cannot be
    // interrupted while it waits for the other end of a pipe.
    if (!writer_is_there() || (lam_path_stat(path, &there) == 0 && !S_ISREG(there.st_mode)))
        return writer_files_save(path, bytes, durable, error);
    return ask(durable ? SAVE_DURABLY : SAVE, path, bytes, error);
}

static bool stage(const struct writer_file *file, lam_error *error)
{
    if (writer_is_there())
        return ask(STAGE, file->path, &file->bytes, error);
    return writer_files_check(file->path, file->right, error) && writer_files_stage(file->path, &file->bytes, error);
}

bool writer_save_all(const struct writer_file *files, int count, lam_error *error)
{
    struct stat there;
    sigset_t all, before;
    bool ok = true;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before); // protects the hidden files if there is no writer
    for (int i = 0; ok && i < count; i++)
        if (files[i].is_named && lam_path_stat(files[i].path, &there) == 0 && !S_ISREG(there.st_mode))
            ok = writer_files_save(files[i].path, &files[i].bytes, false, error);
        else
            ok = stage(&files[i], error);
    lam_error ignored;
    if (!writer_is_there() && ok)
        ok = writer_files_commit(error);
    else if (!writer_is_there())
        writer_files_drop();
    else
        ok = ask(ok ? COMMIT : DROP, ".", &(lam_bytes){0}, ok ? error : &ignored) && ok;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return ok;
}

void writer_remove(const char *path)
{
    lam_error error;
    if (writer_is_there())
        ask(REMOVE, path, &(lam_bytes){0}, &error);
    else
        writer_files_remove(path);
}

#else

bool writer_start(const struct sandbox_paths *paths, uint64_t largest, lam_error *error)
{
    (void)paths, (void)largest;
    return complain(error, LAM_UNSUPPORTED, "this system cannot run the process that writes files");
}

bool writer_is_there(void) { return false; }

pid_t writer_process(void) { return getpid(); }

pid_t writer_leave(void) { return 0; }

void writer_finish(void) {}

void writer_end(void) {}

bool writer_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error)
{
    return writer_files_save(path, bytes, durable, error);
}

bool writer_save_all(const struct writer_file *files, int count, lam_error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        ok = writer_files_check(files[i].path, files[i].right, error) &&
             writer_files_stage(files[i].path, &files[i].bytes, error);
    if (ok)
        return writer_files_commit(error);
    writer_files_drop();
    return false;
}

void writer_remove(const char *path) { writer_files_remove(path); }

#endif
