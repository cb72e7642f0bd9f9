// view_tasks.c: distributes requested pictures to drawing processes.
#include "view_tasks.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "file_io.h"
#include "limit_options.h"
#include "progress.h"
#include "sandbox_start.h"

enum {
    GRACE_MS = 5000,
    CANCEL_MS = 2000,
};
static const uint64_t data_max = (uint64_t)1 << 33; // the maximum size of an answer

struct start {
    const struct view_files *files;
    const struct options *options;
};

static void draw(void *user, int from, int to)
{
    const struct start *start = user;
    // A network connection would otherwise stay open until this process ends.
    close_files((int[]){from, to, sandbox_active()->starter}, 3);
    // The server's filter allows connections and new processes. A drawing process needs neither, so it installs a
    // stricter filter. Landlock already restricts the folders of the server and of the drawing process.
    if (sandbox_active()->filter && !sandbox_filter_install(SANDBOX_DRAWS, sandbox_active()->starter))
        _exit(1);
    view_draw_serve(start->files, start->options, from, to);
}

// Starts a process. Returns false and sets errno on failure.
static bool process_start(struct view_process *process, const struct view_files *files, const struct options *options)
{
    *process = (struct view_process){.child = NO_CHILD};
    return child_start(&process->child, draw, &(struct start){files, options});
}

// Sends a request and its words. Returns false and sets errno on failure.
static bool process_ask(struct view_process *process, const struct view_request *request, const char *words, void *task)
{
    char *model = strdup(words);
    if (!model)
        return false;
    free(process->model);
    process->model = model;
    process->task = task;
    process->cancelled = false;
    process->child.received.size = 0;
    return write_all(process->child.to, request, sizeof *request) &&
           write_all(process->child.to, words, (size_t)request->size);
}

// Requests the cancellation of the current request. A process that does not react is killed after two seconds.
static void process_cancel(struct view_process *process)
{
    if (process->child.pid > 0 && !process->cancelled) {
        process->cancelled = true;
        process->child.stop_ms = clock_ms() + CANCEL_MS;
        kill(process->child.pid, SIGUSR1);
    }
}

// Reads the available bytes. If the answer is complete, sets *reply and returns 1. Returns 0 if the answer is
// incomplete, and −1 if the process has ended or sent an invalid answer.
static int process_receive(struct view_process *p, struct view_reply *reply)
{
    struct child_bytes *received = &p->child.received;
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

// Returns a complete answer: the header, the notes and the data, allocated with malloc. The process can then handle the
// next request.
static char *process_take(struct view_process *process)
{
    char *received = process->child.received.data;
    if (received) // process_receive reserved a byte for the end
        received[process->child.received.size] = 0;
    process->child.received = (struct child_bytes){0};
    process->task = NULL;
    process->child.stop_ms = 0;
    return received;
}

// Kills the process and waits for its end.
static void process_end(struct view_process *process)
{
    child_kill(&process->child);
    child_wait(&process->child);
    child_free(&process->child);
    free(process->model);
    *process = (struct view_process){.child = NO_CHILD};
}

// --- tasks

void view_tasks_start(struct view_tasks *tasks, const struct view_files *files, const struct options *options,
                      void (*done)(void *user, struct view_result *result))
{
    int cores = options->work.threads ? options->work.threads : lam_processors_available();
    double limit_s = limits_time(options);
    *tasks = (struct view_tasks){.files = files, .options = options, .done = done};
    tasks->count = (cores > VIEW_PROCESSES_MAX - 1 ? VIEW_PROCESSES_MAX - 1 : cores) + 1;
    tasks->time_limit_ms = limit_s > 0 ? limit_s * 1e3 + GRACE_MS : 0;
    for (int i = 0; i < VIEW_PROCESSES_MAX; i++)
        tasks->processes[i] = (struct view_process){.child = NO_CHILD};
}

static void free_task(struct view_tasks *tasks, struct view_task *task)
{
    for (struct view_task **at = &tasks->first; *at; at = &(*at)->next)
        if (*at == task) {
            *at = task->next;
            break;
        }
    free(task->words);
    free(task->client);
    free(task);
}

static void finish(struct view_tasks *tasks, struct view_task *task, struct view_result *result)
{
    void *user = task->user;
    free_task(tasks, task);
    if (user)
        tasks->done(user, result);
    else
        free(result->bytes);
}

static struct view_process *process_of(struct view_tasks *tasks, const struct view_task *task)
{
    for (int i = 0; i < tasks->count; i++)
        if (tasks->processes[i].child.pid > 0 && tasks->processes[i].task == task)
            return &tasks->processes[i];
    return NULL;
}

// Cancels a task. If no process works on the task yet, the next call of view_tasks_step ends the task.
static void cancel(struct view_tasks *tasks, struct view_task *task)
{
    task->superseded = true;
    struct view_process *process = process_of(tasks, task);
    if (process)
        process_cancel(process);
}

struct view_task *view_tasks_add(struct view_tasks *tasks, const struct view_request *request, const char *words,
                                 const char *client, void *user)
{
    struct view_task *task = calloc(1, sizeof *task), **end = &tasks->first;
    if (!task)
        return NULL;
    task->request = *request;
    task->words = malloc((size_t)request->size + 1);
    task->client = client ? strdup(client) : NULL;
    task->user = user;
    if (!task->words || (client && !task->client)) {
        free_task(tasks, task);
        return NULL;
    }
    memcpy(task->words, words, (size_t)request->size);
    task->words[request->size] = 0;
    for (struct view_task *other = tasks->first; client && other; other = other->next)
        if (other->client && strcmp(other->client, client) == 0 && other->request.kind == request->kind)
            cancel(tasks, other);
    while (*end)
        end = &(*end)->next;
    *end = task;
    return task;
}

void view_tasks_drop(struct view_tasks *tasks, struct view_task *task)
{
    task->user = NULL;
    if (!task->running)
        free_task(tasks, task);
    else
        cancel(tasks, task);
}

// Returns the process for a task. Prefers an idle process that has loaded the model, then a new process. If the maximum
// number of processes is running, ends an idle process with another model and returns its entry for the new process.
// Returns NULL if the task must wait.
static struct view_process *find_process(struct view_tasks *tasks, const struct view_task *task)
{
    struct view_process *free_one = NULL, *waiting = NULL;
    int pictures = 0;
    for (int i = 0; i < tasks->count; i++) {
        struct view_process *p = &tasks->processes[i];
        pictures += p->child.pid > 0 && p->task && !((const struct view_task *)p->task)->client;
        if (p->child.pid > 0 && p->model && task->client && strcmp(p->model, task->words) == 0 &&
            (!p->task || p->cancelled))
            return p->task ? NULL : p; // waits for a cancelled process that has loaded the model
        free_one = !p->child.pid && !free_one ? p : free_one;
        waiting = p->child.pid > 0 && !p->task && !waiting ? p : waiting;
    }
    if (!task->client && pictures >= tasks->count - 1)
        return NULL;
    if (!free_one && waiting) {
        process_end(waiting); // each model has its own process
        free_one = waiting;
    }
    return free_one;
}

static void fail(struct view_tasks *tasks, struct view_task *task, int status, const char *sentence)
{
    struct view_result result = {.status = status, .bytes = strdup(sentence), .notes = strlen(sentence)};
    result.notes = result.bytes ? result.notes : 0;
    finish(tasks, task, &result);
}

static bool begin(struct view_tasks *tasks, struct view_task *task, struct view_process *process)
{
    if (!process->child.pid && !process_start(process, tasks->files, tasks->options))
        return false;
    task->running = true;
    if (!process_ask(process, &task->request, task->words, task)) {
        int reason = errno;
        process_end(process);
        errno = reason;
        return false;
    }
    process->child.stop_ms = tasks->time_limit_ms > 0 ? clock_ms() + tasks->time_limit_ms : 0;
    return true;
}

static void begin_waiting(struct view_tasks *tasks)
{
    for (struct view_task *task = tasks->first, *next; task; task = next) {
        next = task->next;
        if (task->running)
            continue;
        if (task->superseded) {
            fail(tasks, task, 409, "cancelled");
            continue;
        }
        struct view_process *process = find_process(tasks, task);
        if (process && !begin(tasks, task, process)) {
            char sentence[200];
            snprintf(sentence, sizeof sentence, "cannot start a drawing process: %s", strerror(errno));
            fail(tasks, task, 503, sentence);
        }
    }
}

// Ends a process that has failed or takes too long, and reports the failure of its task.
static void lose(struct view_tasks *tasks, struct view_process *process, const char *sentence)
{
    struct view_task *task = process->task;
    bool cancelled = process->cancelled;
    process_end(process);
    if (task)
        fail(tasks, task, cancelled ? 409 : 422, cancelled ? "cancelled" : sentence);
}

static void receive(struct view_tasks *tasks, struct view_process *process)
{
    struct view_reply reply;
    struct view_task *task = process->task;
    int whole = process_receive(process, &reply);
    if (whole < 0)
        lose(tasks, process, "the drawing process ended without a result");
    if (whole <= 0)
        return;
    struct view_result result = {
        .status = reply.status, .notes_at = sizeof reply, .notes = reply.notes, .data = (size_t)reply.data};
    result.bytes = process_take(process);
    if (!task) { // no task is waiting for this answer
        free(result.bytes);
        process_end(process);
        return;
    }
    if (!task->client || !reply.keeps) // a thumbnail's model is drawn only once
        process_end(process);
    finish(tasks, task, &result);
}

static bool is_readable(int file)
{
    struct pollfd wait = {.fd = file, .events = POLLIN};
    return poll(&wait, 1, 0) > 0;
}

void view_tasks_step(struct view_tasks *tasks)
{
    double now = clock_ms();
    for (int i = 0; i < tasks->count; i++) {
        struct view_process *p = &tasks->processes[i];
        for (int reads = 0; reads < 64 && p->child.pid > 0 && is_readable(p->child.from); reads++)
            receive(tasks, p);
        if (p->child.pid > 0 && p->task && p->cancelled)
            kill(p->child.pid, SIGUSR1); // repeated in case the process has not read the request yet
        if (p->child.pid > 0 && p->task && p->child.stop_ms > 0 && now > p->child.stop_ms)
            lose(tasks, p, "the time limit was reached (--time-limit)");
    }
    begin_waiting(tasks);
}

void view_tasks_end(struct view_tasks *tasks)
{
    for (int i = 0; i < tasks->count; i++)
        if (tasks->processes[i].child.pid > 0)
            process_end(&tasks->processes[i]);
    while (tasks->first)
        fail(tasks, tasks->first, 503, "the viewer has ended");
}
