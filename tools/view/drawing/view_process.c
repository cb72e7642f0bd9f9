// view_process.c: starts and controls drawing processes.
#include "view_process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "console.h"
#include "file_io.h"
#include "interrupt.h"
#include "progress.h"
#include "sandbox_start.h"

enum {
    CANCEL_MS = 2000,
    FILES_MAX = 4096, // above all handles of the server, whose connections are limited
};
static const uint64_t data_max = (uint64_t)1 << 33; // the maximum size of an answer

// Closes other handles, because a connection stays open as long as any process has a handle to it.
static void close_others(int first, int second)
{
    for (int file = 3; file < FILES_MAX; file++) {
        struct stat about;
        if (file != first && file != second && fstat(file, &about) == 0 &&
            !S_ISDIR(about.st_mode)) // the handle of the files' folder stays open
            close(file);
    }
}

static _Noreturn void run(const struct view_files *files, const struct options *options, pid_t server, int from, int to)
{
    interrupt_with_parent(server);
    close_others(from, to);
    // The server's filter allows connections and processes, which a drawing process does not need. Landlock already
    // restricts its folders.
    if (sandbox_active()->filter && !sandbox_filter_install(SANDBOX_DRAWS))
        _exit(1);
    view_draw_serve(files, options, from, to);
}

bool view_process_start(struct view_process *process, const struct view_files *files, const struct options *options)
{
    int requests[2], answers[2];
    *process = (struct view_process){.to = -1, .from = -1};
    if (pipe2(requests, O_CLOEXEC) != 0)
        return false;
    if (pipe2(answers, O_CLOEXEC) != 0) {
        close(requests[0]);
        close(requests[1]);
        return false;
    }
    pid_t server = getpid();
    process->pid = fork();
    if (process->pid == 0)
        run(files, options, server, requests[0], answers[1]);
    int reason = errno;
    close(requests[0]);
    close(answers[1]);
    process->to = requests[1];
    process->from = answers[0];
    if (process->pid > 0)
        return true;
    process->pid = 0;
    view_process_end(process);
    errno = reason;
    return false;
}

bool view_process_ask(struct view_process *process, const struct view_request *request, const char *words, void *task)
{
    char *model = strdup(words);
    if (!model)
        return false;
    free(process->model);
    process->model = model;
    process->task = task;
    process->cancelled = false;
    process->size = 0;
    return write_all(process->to, request, sizeof *request) && write_all(process->to, words, (size_t)request->size);
}

void view_process_cancel(struct view_process *process)
{
    if (process->pid > 0 && !process->cancelled) {
        process->cancelled = true;
        process->stop_ms = clock_ms() + CANCEL_MS;
        kill(process->pid, SIGUSR1);
    }
}

// Enlarges the buffer to `size` bytes.
static bool reserve(struct view_process *p, size_t size)
{
    if (size <= p->capacity)
        return true;
    char *more = realloc(p->received, size);
    if (!more)
        return false;
    p->received = more;
    p->capacity = size;
    return true;
}

int view_process_receive(struct view_process *p, struct view_reply *reply)
{
    size_t whole = sizeof *reply;
    if (p->size >= sizeof *reply) {
        memcpy(reply, p->received, sizeof *reply);
        if (reply->data > data_max)
            return -1;
        whole += reply->notes + (size_t)reply->data;
    }
    if (!reserve(p, whole + 1))
        return -1;
    if (p->size < whole) {
        ssize_t got = read(p->from, p->received + p->size, whole - p->size);
        if (got < 0 && errno == EINTR)
            return 0;
        if (got <= 0)
            return -1;
        p->size += (size_t)got;
    }
    if (p->size < sizeof *reply || p->size < whole)
        return 0;
    memcpy(reply, p->received, sizeof *reply);
    return p->size == sizeof *reply + reply->notes + reply->data;
}

char *view_process_take(struct view_process *process)
{
    char *received = process->received;
    if (received)
        received[process->size] = 0;
    process->received = NULL;
    process->size = process->capacity = 0;
    process->task = NULL;
    process->stop_ms = 0;
    return received;
}

void view_process_end(struct view_process *process)
{
    if (process->to >= 0)
        close(process->to);
    if (process->from >= 0)
        close(process->from);
    if (process->pid > 0) {
        kill(process->pid, SIGKILL);
        while (waitpid(process->pid, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
    free(process->received);
    free(process->model);
    *process = (struct view_process){.to = -1, .from = -1};
}
