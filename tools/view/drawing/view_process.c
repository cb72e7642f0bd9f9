// view_process.c: starts and controls drawing processes.
#include "view_process.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"
#include "file_io.h"
#include "progress.h"
#include "sandbox_start.h"

enum {
    CANCEL_MS = 2000,
    FILES_MAX = 4096, // larger than any file handle of the server, because the server limits its number of connections
};
static const uint64_t data_max = (uint64_t)1 << 33; // the maximum size of an answer

// Closes all other handles. A network connection would otherwise stay open until this process ends.
static void close_others(int first, int second)
{
    for (int file = 3; file < FILES_MAX; file++) {
        struct stat about;
        if (file != first && file != second && fstat(file, &about) == 0 &&
            !S_ISDIR(about.st_mode)) // the handle of the files' folder stays open
            close(file);
    }
}

struct start {
    const struct view_files *files;
    const struct options *options;
};

static void run(void *user, int from, int to)
{
    const struct start *start = user;
    close_others(from, to);
    // The server's filter allows connections and new processes. A drawing process needs neither, so it installs a
    // stricter filter. Landlock already restricts the folders of the server and of the drawing process.
    if (sandbox_active()->filter && !sandbox_filter_install(SANDBOX_DRAWS))
        _exit(1);
    view_draw_serve(start->files, start->options, from, to);
}

bool view_process_start(struct view_process *process, const struct view_files *files, const struct options *options)
{
    *process = (struct view_process){.child = NO_CHILD};
    return child_start(&process->child, run, &(struct start){files, options});
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
    process->received.size = 0;
    return write_all(process->child.to, request, sizeof *request) &&
           write_all(process->child.to, words, (size_t)request->size);
}

void view_process_cancel(struct view_process *process)
{
    if (process->child.pid > 0 && !process->cancelled) {
        process->cancelled = true;
        process->stop_ms = clock_ms() + CANCEL_MS;
        kill(process->child.pid, SIGUSR1);
    }
}

int view_process_receive(struct view_process *p, struct view_reply *reply)
{
    struct child_bytes *received = &p->received;
    size_t whole = sizeof *reply;
    if (received->size >= sizeof *reply) {
        memcpy(reply, received->data, sizeof *reply);
        if (reply->data > data_max)
            return -1;
        whole += reply->notes + (size_t)reply->data;
    }
    if (!child_bytes_reserve(received, whole - received->size + 1))
        return -1;
    if (received->size < whole && child_read(p->child.from, received, whole - received->size) != CHILD_READ)
        return -1;
    if (received->size < sizeof *reply || received->size < whole)
        return 0;
    memcpy(reply, received->data, sizeof *reply);
    return received->size == sizeof *reply + reply->notes + reply->data;
}

char *view_process_take(struct view_process *process)
{
    char *received = process->received.data;
    if (received) // view_process_receive reserved a byte for the end
        received[process->received.size] = 0;
    process->received = (struct child_bytes){0};
    process->task = NULL;
    process->stop_ms = 0;
    return received;
}

void view_process_end(struct view_process *process)
{
    child_kill(&process->child);
    child_wait(&process->child);
    free(process->received.data);
    free(process->model);
    *process = (struct view_process){.child = NO_CHILD};
}
