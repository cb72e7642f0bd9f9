// import_process.c: starts lambent-import, and exchanges bytes with it.
//
// A process without a sandbox starts lambent-import by posix_spawn, which is safe in a host with threads. A process
// that will enter a sandbox first starts one as the starter (lam_import_start), and later sends it the ends of two pipes.
#include "import_process.h"

#include <lambent/scene.h>

#include "dynamic_library.h"
#include "fail.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

// The C library's sin and pow have variants for newer processors, which round differently. Without these, the readers
// compute the same bits on every processor. One memory pool, because each thread's pool reserves address space.
#define TUNABLES "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F:glibc.malloc.arena_max=1"

// Starts lambent-import with these standard streams. Returns its process ID, or 0 and sets errno.
static pid_t spawn(const char *path, int in, int out, const char *argument)
{
    const char *libraries = getenv("LD_LIBRARY_PATH");
    char search[4096];
    bool fits = libraries && (size_t)snprintf(search, sizeof search, "LD_LIBRARY_PATH=%s", libraries) < sizeof search;
    char *environment[] = {(char *)TUNABLES, (char *)"LC_ALL=C", fits ? search : NULL, NULL};
    char *line[] = {(char *)IMPORT_PROGRAM, (char *)argument, NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none, all;
    pid_t process = 0;
    sigemptyset(&none);
    sigfillset(&all);
    // Copies, which are not the standard streams of a host that has closed its own.
    const int handles[2] = {fcntl(in, F_DUPFD_CLOEXEC, STDERR_FILENO + 1),
                            fcntl(out, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)};
    posix_spawn_file_actions_init(&files); // these calls can fail only if memory runs out
    posix_spawnattr_init(&how);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setsigdefault(&how, &all);
    int failed = posix_spawn_file_actions_adddup2(&files, handles[0], STDIN_FILENO);
    failed = failed ? failed : posix_spawn_file_actions_adddup2(&files, handles[1], STDOUT_FILENO);
    failed = failed ? failed : posix_spawn(&process, path, &files, &how, line, environment);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    for (int i = 0; i < 2; i++)
        if (handles[i] >= 0)
            close(handles[i]);
    errno = failed;
    return failed ? 0 : process;
}

static int starter = -1;

int lam_import_start(void)
{
    char path[LIBRARY_PATH_SIZE];
    int pair[2];
    if (starter >= 0 || !library_own_path(IMPORT_PROGRAM, path) ||
        socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0)
        return starter;
    if (spawn(path, pair[1], pair[1], IMPORT_STARTER) > 0)
        starter = fcntl(pair[0], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(pair[0]);
    close(pair[1]);
    return starter;
}

// --- one file

struct run {
    int request[2], answer[2]; // pipes, each with its end for reading first; −1 if closed
    pid_t process;             // 0 if the starter started it
};

static bool ask_starter(int in, int out)
{
    char byte = 0;
    union import_handles handles = {.space = {0}};
    struct iovec data = {&byte, 1};
    struct msghdr message = {
        .msg_iov = &data, .msg_iovlen = 1, .msg_control = &handles, .msg_controllen = sizeof handles};
    struct cmsghdr *head = CMSG_FIRSTHDR(&message);
    *head = (struct cmsghdr){.cmsg_len = CMSG_LEN(2 * sizeof(int)), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_RIGHTS};
    memcpy(CMSG_DATA(head), (int[]){in, out}, 2 * sizeof(int));
    ssize_t sent;
    while ((sent = sendmsg(starter, &message, MSG_NOSIGNAL)) < 0 && errno == EINTR)
        continue;
    return sent == 1;
}

static bool start(struct run *run, const char *name, lam_error *error)
{
    char path[LIBRARY_PATH_SIZE];
    bool ok = pipe2(run->request, O_CLOEXEC) == 0 && pipe2(run->answer, O_CLOEXEC) == 0;
    if (ok && starter >= 0)
        ok = ask_starter(run->request[0], run->answer[1]);
    else if (ok)
        ok = library_own_path(IMPORT_PROGRAM, path) &&
             (run->process = spawn(path, run->request[0], run->answer[1], NULL)) > 0;
    if (!ok)
        return fail(error, LAM_MACHINE, "%s: cannot start " IMPORT_PROGRAM ": %s", name, strerror(errno));
    close(run->answer[1]); // the other end for reading stays open, so that writing raises no SIGPIPE
    run->answer[1] = -1;
    return true;
}

static void end(struct run *run)
{
    const int files[] = {run->request[1], run->request[0], run->answer[0], run->answer[1]};
    for (int i = 0; i < 4; i++)
        if (files[i] >= 0)
            close(files[i]); // lambent-import ends
    if (run->process > 0)
        kill(run->process, SIGKILL);
    while (run->process > 0 && waitpid(run->process, NULL, 0) < 0 && errno == EINTR)
        continue;
}

struct transfer {
    uint8_t *bytes;
    size_t done, size;
};

// Sends or receives a part, after poll(). Returns the number of bytes; 0 at the end, and −1 after an error.
static ssize_t transfer(struct transfer *t, int file, bool sends)
{
    const size_t left = t->size - t->done, part = left < PIPE_BUF ? left : PIPE_BUF; // as much does not block
    ssize_t moved = sends ? write(file, t->bytes + t->done, part) : read(file, t->bytes + t->done, left);
    t->done += moved > 0 ? (size_t)moved : 0;
    return moved;
}

static bool exchange(struct run *run, const struct import_source *source, struct import_request *request,
                     struct import_answer *answer, struct file_bytes *scene, lam_error *error)
{
    enum { WAIT_MS = 50 };
    struct transfer out[2] = {{(uint8_t *)request, 0, sizeof *request},
                              {(uint8_t *)(uintptr_t)source->bytes, 0, source->size}};
    struct transfer in = {(uint8_t *)answer, 0, sizeof *answer};
    while (in.done < in.size) {
        struct transfer *o = &out[out[0].done == out[0].size];
        struct pollfd wait[2] = {{.fd = run->answer[0], .events = POLLIN},
                                 {.fd = o->done < o->size ? run->request[1] : -1, .events = POLLOUT}};
        if (!call_should_continue(source->call))
            return call_error(source->call, error);
        if (poll(wait, 2, WAIT_MS) <= 0)
            continue;
        if (wait[1].revents)
            transfer(o, run->request[1], true);
        if (wait[0].revents && transfer(&in, run->answer[0], false) == 0)
            return fail(error, LAM_CANNOT_READ,
                        "%s: the reader of %s files has failed (" IMPORT_PROGRAM " ended); the file may be damaged",
                        source->name, request->format);
        if (in.bytes != (uint8_t *)answer || in.done < in.size)
            continue;
        if (answer->version != IMPORT_MODULE_VERSION)
            return fail(error, LAM_UNSUPPORTED, "%s: " IMPORT_PROGRAM " belongs to another version of Lambent",
                        source->name);
        if (answer->size && !file_hold(answer->size, source->call, scene, error))
            return false;
        in = (struct transfer){(uint8_t *)(uintptr_t)scene->data, 0, answer->size};
    }
    return true;
}

bool import_run(const struct import_source *source, struct import_request *request, struct import_answer *answer,
                struct file_bytes *scene, lam_error *error)
{
    struct run run = {.request = {-1, -1}, .answer = {-1, -1}};
    bool ok = start(&run, source->name, error) && exchange(&run, source, request, answer, scene, error);
    end(&run);
    if (!ok)
        file_release(scene);
    return ok;
}
