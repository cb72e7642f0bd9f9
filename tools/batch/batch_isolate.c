// batch_isolate.c: draws each model of a pass in a separate process. The process sends its results back. If a process
// ends without sending all results, the pictures of its model are recorded with the class `crashed`.
#include "batch.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "batch_job.h"
#include "batch_sandbox.h"
#include "child.h"
#include "console.h"
#include "limit_options.h"
#include "file_io.h"
#include "interrupt.h"
#include "writer.h"

enum { PROCESSES_MAX = 1024, READ_BYTES = 16 << 10 };

// The milliseconds between interrupting a process and killing it.
static const double interrupt_ms = 600;

// Returns how long a process may exceed its time limit before it is killed: as long as the limit itself, but at least
// half a second and at most five seconds.
static double grace_ms(double limit_s) { return limit_s > 5 ? 5000 : limit_s > 0.5 ? limit_s * 1e3 : 500; }

// --- the process

// A process sends this struct. Then it sends, for each picture, a `sent_picture`, the journal line and the picture's
// file. At the end, it sends its standard output and standard error.
struct sent {
    int code, warnings;
    bool interrupted;
    size_t out_size, err_size;
};

struct sent_picture {
    struct batch_picture picture;
    char class[24];
    bool is_new;
    size_t line_size; // 0 if there is no record
    size_t data_size; // 0 if there is no file
};

// The process that draws a model.
struct batch_process {
    struct child child;
    pid_t writer; // 0, or the writer for this process; the writer ends after the process
};

struct work {
    struct batch *batch;
    struct batch_work *work;
    bool draws; // if false, the process only makes missing thumbnails of earlier pictures
};

static bool enter(const struct batch *b, const struct batch_task *task, lam_error *error)
{
    if (!task->job)
        return batch_sandbox_enter(b, task->model, 1, error);
    int none = open("/dev/null", O_RDWR | O_CLOEXEC); // the process must not read other jobs or write answers
    bool ok = none >= 0 && dup2(none, STDIN_FILENO) >= 0 && dup2(none, STDOUT_FILENO) >= 0;
    return ok ? batch_sandbox_enter_job(task->job, error)
              : complain(error, LAM_CANNOT_READ, "/dev/null: cannot open: %s", strerror(errno));
}

static void draw_here(struct batch *b, struct batch_work *u)
{
    struct options options = *u->task.plan->options;
    options.work.threads = b->threads;
    options.limits.in_flight = b->workers;
    lam_error error = {0};
    lam_device *device = enter(b, &u->task, &error) ? device_option_make(&options, &error) : NULL;
    if (device)
        batch_work_draw(u, b, &options, device, NULL, true);
    else if (asprintf(&u->err, "lambent: %s\n", error.text) >= 0)
        batch_work_fail(u, b, exit_code_of(error.code)->name, exit_code_of(error.code)->code,
                        batch_is_by_machine(&error), error.text);
    lam_device_free(device);
}

static void work(void *user, int from, int to)
{
    const struct work *w = user;
    struct batch_work *u = w->work;
    struct child_bytes all = {0}, *answer = &all;
    lam_error error;
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    close(from);
    if (w->draws)
        draw_here(w->batch, u);
    else if (!enter(w->batch, &u->task, &error))
        _exit(1);
    batch_page_thumbnails(w->batch, u);
    struct sent sent = {u->code, u->warnings, u->interrupted, u->out ? strlen(u->out) : 0, u->err ? strlen(u->err) : 0};
    bool ok = child_bytes_add(answer, &sent, sizeof sent);
    for (int i = 0; ok && i < u->picture_count; i++) {
        char *line = u->is_new[i] && u->records[i] ? journal_line(u->records[i]) : NULL;
        struct sent_picture picture = {
            .picture = u->pictures[i], .is_new = u->is_new[i], .line_size = line ? strlen(line) : 0};
        const lam_bytes *data = u->contents ? &u->contents[i] : NULL;
        picture.data_size = data ? data->size : 0;
        snprintf(picture.class, sizeof picture.class, "%s", u->classes[i] ? u->classes[i] : "");
        ok = child_bytes_add(answer, &picture, sizeof picture) && child_bytes_add(answer, line, picture.line_size) &&
             (!data || child_bytes_add(answer, data->data, data->size));
        free(line);
    }
    ok = ok && child_bytes_add(answer, u->out, sent.out_size) && child_bytes_add(answer, u->err, sent.err_size);
    _exit(!(ok && write_all(to, answer->data, answer->size)));
}

// --- received results

// The bytes that remain to be parsed.
struct rest {
    const char *at;
    size_t size;
};

static bool read_bytes(struct rest *rest, void *to, size_t size)
{
    if (rest->size < size)
        return false;
    if (size) // memcpy must not receive NULL, even for 0 bytes
        memcpy(to, rest->at, size);
    rest->at += size;
    rest->size -= size;
    return true;
}

static bool read_text(struct rest *rest, char **to, size_t size)
{
    *to = size <= rest->size ? malloc(size + 1) : NULL;
    if (!*to)
        return false;
    (*to)[size] = 0;
    return read_bytes(rest, *to, size);
}

// Parses an answer. Returns false if the answer is incomplete.
static bool read_answer(struct batch_work *u, const struct child_bytes *answer)
{
    struct rest rest = {answer->data, answer->size};
    struct sent sent;
    if (!read_bytes(&rest, &sent, sizeof sent))
        return false;
    for (int i = 0; i < u->picture_count; i++) {
        struct sent_picture picture;
        char *line = NULL;
        if (!read_bytes(&rest, &picture, sizeof picture) || !read_text(&rest, &line, picture.line_size))
            return false;
        picture.class[sizeof picture.class - 1] = 0;
        if (picture.is_new && picture.line_size) {
            json_decref(u->records[i]);
            u->records[i] = json_loads(line, 0, NULL);
        }
        free(line);
        char *data = NULL;
        if (u->contents && picture.data_size) {
            if (!read_text(&rest, &data, picture.data_size))
                return false;
            u->contents[i] = (lam_bytes){(uint8_t *)data, picture.data_size};
        }
        u->pictures[i] = picture.picture;
        u->is_new[i] = picture.is_new;
        u->classes[i] = exit_code_name(picture.class);
    }
    u->code = sent.code;
    u->warnings = sent.warnings;
    u->interrupted = sent.interrupted;
    return read_text(&rest, &u->out, sent.out_size) && read_text(&rest, &u->err, sent.err_size);
}

// --- the parent process

static void fail_process(struct batch *b, struct batch_work *u, const struct batch_process *process, int status)
{
    const char *model = u->task.plan->models[u->task.model].path;
    lam_error error;
    bool crashed = !process->child.stopped;
    if (!crashed)
        complain(&error, LAM_LIMIT, "%.400s: the time limit of %.10g s was reached", model,
                 limits_time(u->task.plan->options));
    else if (WIFSIGNALED(status))
        complain(&error, LAM_LIMIT, "%.400s: its process was ended by signal %d (%s)", model, WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
    else
        complain(&error, LAM_LIMIT, "%.400s: its process ended without a result (%d)", model, WEXITSTATUS(status));
    free(u->out);
    free(u->err);
    u->out = u->err = NULL;
    if (asprintf(&u->err, "lambent: %s\n", error.text) < 0)
        u->err = NULL;
    const char *class = crashed ? "crashed" : exit_code_of(LAM_LIMIT)->name;
    batch_work_fail(u, b, class, crashed ? EXIT_CRASHED : exit_code_of(LAM_LIMIT)->code, crashed, error.text);
}

static bool has_open(const struct batch_work *u)
{
    bool open = false;
    for (int i = 0; i < u->picture_count; i++)
        open |= u->pictures[i].outcome == PICTURE_OPEN;
    return open;
}

static void finish_slot(struct batch *b, struct batch_work *u, struct batch_process *process, int status)
{
    size_t size = (size_t)u->picture_count * sizeof *u->pictures;
    struct batch_picture *before = malloc(size);
    if (before)
        memcpy(before, u->pictures, size);
    bool whole = WIFEXITED(status) && WEXITSTATUS(status) == 0 && read_answer(u, &process->child.received);
    child_wait_pid(process->writer);
    if (!whole) {
        if (before)
            memcpy(u->pictures, before, size);
        batch_remove_parts(u->task.plan, u->task.model, process->writer ? process->writer : process->child.pid, NULL);
        bool cancelled = u->task.job && u->task.job->cancelled;
        u->interrupted |= cancelled;
        if (!interrupted() && !cancelled && has_open(u)) // otherwise the process only made thumbnails
            fail_process(b, u, process, status);
    }
    free(before);
    batch_deliver(b, u);
    batch_work_free(u);
    child_free(&process->child);
}

// Starts a process for the next model. Returns false if there is no next model.
static bool fill_slot(struct batch *b, struct batch_work *u, struct batch_process *process, int slot)
{
    struct batch_task task;
    lam_error error = {0};
    while (batch_take(b, &task, false)) {
        error.code = LAM_OK;
        if (!batch_work_start(u, b, &task, &error)) {
            batch_stop(b, &error);
            return false;
        }
        const char *path = task.plan->models[task.model].path;
        double limit_s = limits_time(task.plan->options);
        bool open = batch_work_look(u, b);
        struct work w = {b, u, open};
        fflush(stdout);
        bool started = (open || batch_page_lacks(b, u)) && batch_sandbox_start_writer(b, &task, &error) &&
                       child_start(&process->child, work, &w);
        pid_t writer = writer_leave();
        if (started) {
            child_send_end(&process->child);
            process->writer = writer;
            if (limit_s > 0)
                process->child.stop_ms = clock_ms() + limit_s * 1e3 * u->picture_count + grace_ms(limit_s);
            if (b->journal)
                journal_begin(b->journal, slot, writer ? writer : process->child.pid, path);
            return true;
        }
        child_wait_pid(writer);
        if (open) {
            if (!error.code)
                complain(&error, LAM_MACHINE, "%.400s: cannot start a process: %s", path, strerror(errno));
            if (asprintf(&u->err, "lambent: %s\n", error.text) < 0)
                u->err = NULL;
            batch_work_fail(u, b, exit_code_of(LAM_LIMIT)->name, exit_code_of(LAM_LIMIT)->code,
                            batch_is_by_machine(&error), error.text);
        }
        batch_deliver(b, u);
        batch_work_free(u);
    }
    return false;
}

// Forwards an interrupt to the processes, and kills the processes that do not end in time.
static void end_processes(struct batch_process *processes, int count, double *since_ms)
{
    if (!interrupted())
        return;
    bool first = *since_ms == 0;
    *since_ms = first ? clock_ms() : *since_ms;
    bool late = clock_ms() - *since_ms > interrupt_ms;
    for (int i = 0; i < count; i++)
        if (processes[i].child.pid > 0 && (first || late))
            kill(processes[i].child.pid, late ? SIGKILL : SIGTERM);
}

// Ends the processes of cancelled jobs.
static void end_cancelled(const struct batch_work *units, struct batch_process *processes, int count)
{
    for (int i = 0; i < count; i++)
        if (processes[i].child.pid > 0 && units[i].task.job && units[i].task.job->cancelled)
            child_kill(&processes[i].child);
}

// Waits at most `wait_ms` until a process sends data, a process ends, or the file `also` (−1 if there is none) is
// readable. Returns the index of a process that has ended, with the status from waitpid, or −1 if no process has ended.
static int wait_processes(struct batch_process *list, int count, int also, int wait_ms, int *status)
{
    struct pollfd wait[PROCESSES_MAX + 1];
    count = count < PROCESSES_MAX ? count : PROCESSES_MAX;
    for (int i = 0; i < count; i++) {
        struct child *child = &list[i].child;
        wait[i] = (struct pollfd){.fd = child->pid ? child->from : -1, .events = POLLIN};
        if (child->pid && child->stop_ms > 0 && clock_ms() > child->stop_ms && !child->stopped) {
            child->stopped = true;
            child_kill(child);
        }
    }
    wait[count] = (struct pollfd){.fd = also, .events = POLLIN};
    if (poll(wait, (nfds_t)count + 1, wait_ms) <= 0)
        return -1;
    for (int i = 0; i < count; i++) {
        struct child *child = &list[i].child;
        if (wait[i].fd < 0 || !wait[i].revents || child_read(child->from, &child->received, READ_BYTES) == CHILD_READ)
            continue;
        *status = child_wait(child);
        return i;
    }
    return -1;
}

void batch_isolate(struct batch *b)
{
    struct batch_work *units = calloc((size_t)b->workers, sizeof *units);
    struct batch_process *processes = calloc((size_t)b->workers, sizeof *processes);
    lam_error error;
    if (!units || !processes) {
        complain(&error, LAM_MACHINE, "out of memory");
        batch_stop(b, &error);
    }
    int running = 0;
    double since_ms = 0;
    for (bool more = units && processes; more || running;) {
        if (b->jobs)
            batch_jobs_step(b->jobs, running || batch_jobs_waiting(b->jobs) ? 0 : 100);
        for (int i = 0; more && i < b->workers; i++)
            if (processes[i].child.pid == 0) {
                more = fill_slot(b, &units[i], &processes[i], i);
                running += more;
            }
        if (b->jobs) // more jobs may arrive
            more = units && processes && !batch_jobs_over(b->jobs);
        if (!running && !b->jobs)
            break;
        end_processes(processes, b->workers, &since_ms);
        end_cancelled(units, processes, b->workers);
        bool reads = b->jobs && batch_jobs_is_ready(b->jobs);
        int also = b->jobs ? batch_jobs_wanted(b->jobs) : -1, status;
        int ended = wait_processes(processes, b->workers, also, running && !reads ? 100 : 0, &status);
        batch_show_progress(&b->tally);
        if (ended < 0)
            continue;
        finish_slot(b, &units[ended], &processes[ended], status);
        running--;
    }
    free(units);
    free(processes);
}
