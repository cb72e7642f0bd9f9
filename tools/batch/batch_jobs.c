// batch_jobs.c: implements the queue of --jobs: reads jobs as lines of JSON, passes them to workers, and answers them.
#include "batch.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>
#include <unistd.h>

#include "batch_job.h"
#include "console.h"
#include "interrupt.h"

enum { LINE_LIMIT = 64000000 }; // bytes

struct list {
    struct batch_job *first, **end;
};

struct batch_jobs {
    struct batch *batch;
    struct batch_job_rules rules;
    struct list_rows list; // of --list
    struct job_stream stream;
    size_t ahead;           // how many jobs may wait
    struct job_answers out; // has its own lock

    pthread_mutex_t lock; // protects the members below
    pthread_cond_t changed;
    struct list waiting, drawing;
    size_t waiting_count, waiting_bytes; // number of waiting jobs, and the bytes of their models in memory
    struct batch_job *held;              // the job that was read while the queue was full
    bool closed;                         // no more lines are read
    bool given_up;                       // all jobs were cancelled
};

// --- lists

static void list_start(struct list *list) { *list = (struct list){NULL, &list->first}; }

static void list_add(struct list *list, struct batch_job *job)
{
    job->next = NULL;
    *list->end = job;
    list->end = &job->next;
}

static bool list_remove(struct list *list, const struct batch_job *job)
{
    struct batch_job **at = &list->first;
    while (*at && *at != job)
        at = &(*at)->next;
    if (!*at)
        return false;
    if (list->end == &(*at)->next)
        list->end = at;
    *at = (*at)->next;
    return true;
}

static struct batch_job *list_find(const struct list *list, const json_t *id)
{
    struct batch_job *job = list->first;
    while (job && !json_equal(job->id, id))
        job = job->next;
    return job;
}

// --- opening

static bool open_stream(struct batch_jobs *jobs, const char *path, lam_error *error)
{
    bool standard = strcmp(path, "-") == 0;
    jobs->stream.file = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    return jobs->stream.file >= 0 ||
           complain(error, LAM_CANNOT_READ, "%s: cannot read the jobs: %s", path, strerror(errno));
}

struct batch_jobs *batch_jobs_open(struct batch *b, lam_error *error)
{
    const struct options *o = b->options;
    struct batch_jobs *jobs = calloc(1, sizeof *jobs);
    if (!jobs)
        return complain(error, LAM_MACHINE, "out of memory"), NULL;
    jobs->batch = b;
    jobs->stream =
        (struct job_stream){.file = -1, .limit = o->batch.line_limit_bytes ? o->batch.line_limit_bytes : LINE_LIMIT};
    jobs->ahead = o->batch.ahead ? (size_t)o->batch.ahead : 2 * (size_t)b->workers;
    jobs->rules = (struct batch_job_rules){
        .options = o, .threads = b->threads, .in_flight = b->workers, .has_keys = b->journal != NULL};
    const size_t length = strlen(o->batch.jobs);
    jobs->list.is_csv = length > 4 && strcasecmp(o->batch.jobs + length - 4, ".csv") == 0;
    list_start(&jobs->waiting);
    list_start(&jobs->drawing);
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&jobs->lock, NULL);
    pthread_cond_init(&jobs->changed, &monotonic);
    pthread_condattr_destroy(&monotonic);
    job_answers_start(&jobs->out);
    if (job_roots_check(o, error) && open_stream(jobs, o->batch.jobs, error))
        return jobs;
    batch_jobs_close(jobs);
    return NULL;
}

static void free_list(struct list *list)
{
    for (struct batch_job *job; (job = list->first);) {
        list->first = job->next;
        batch_job_free(job);
    }
}

void batch_jobs_close(struct batch_jobs *jobs)
{
    if (!jobs)
        return;
    free_list(&jobs->waiting);
    free_list(&jobs->drawing);
    batch_job_free(jobs->held);
    if (jobs->stream.file > STDIN_FILENO)
        close(jobs->stream.file);
    free(jobs->stream.data);
    json_decref(jobs->list.columns);
    json_decref(jobs->list.outputs);
    job_answers_end(&jobs->out);
    pthread_cond_destroy(&jobs->changed);
    pthread_mutex_destroy(&jobs->lock);
    free(jobs);
}

// --- answers without a picture

static void count(struct batch_jobs *jobs, const lam_error *error, size_t pictures)
{
    struct batch *b = jobs->batch;
    pthread_mutex_lock(&b->lock);
    b->tally.total += pictures;
    if (error && error->code == LAM_CANCELLED) {
        b->tally.cancelled += pictures;
    } else if (error) {
        b->tally.failed += pictures;
        batch_count_class(&b->tally, exit_code_of(error->code)->name);
    }
    pthread_mutex_unlock(&b->lock);
}

// Rejects a line. `id` is NULL if the line has no id or the id belongs to another job.
static void refuse(struct batch_jobs *jobs, json_t *id, uint64_t line, const char *outcome, const lam_error *reason)
{
    lam_error error;
    complain(&error, reason->code, "line %" PRIu64 ": %.440s", line, reason->text);
    job_answer_error(&jobs->out, id, line, outcome, &error);
}

static void answer_cancelled(struct batch_jobs *jobs, struct batch_job *job, const char *why)
{
    lam_error error;
    complain(&error, LAM_CANCELLED, "%.400s: %s", job->plan.models[0].path, why);
    size_t pictures = (size_t)job->plan.view_count;
    pthread_mutex_lock(&jobs->batch->lock);
    jobs->batch->tally.cancelled += pictures;
    pthread_mutex_unlock(&jobs->batch->lock);
    job_answer_error(&jobs->out, job->id, 0, "cancelled", &error);
    batch_job_free(job);
}

// --- lines

static bool has_room(const struct batch_jobs *jobs)
{
    return jobs->waiting_count < jobs->ahead && (!jobs->waiting_count || jobs->waiting_bytes < jobs->stream.limit);
}

static void cancel(struct batch_jobs *jobs, json_t *id, uint64_t line)
{
    pthread_mutex_lock(&jobs->lock);
    struct batch_job *waits = list_find(&jobs->waiting, id), *drawn = waits ? NULL : list_find(&jobs->drawing, id);
    if (waits) {
        list_remove(&jobs->waiting, waits);
        jobs->waiting_count--;
        jobs->waiting_bytes -= waits->bytes.size;
    } else if (drawn) {
        drawn->cancelled = true;
        lam_cancel_raise(&drawn->cancel);
    }
    pthread_mutex_unlock(&jobs->lock);
    lam_error error;
    if (waits) {
        answer_cancelled(jobs, waits, "cancelled");
    } else if (!drawn) {
        complain(&error, LAM_BAD_ARGUMENT, "key 'cancel': no job with this id is waiting or being drawn");
        refuse(jobs, NULL, line, "ignored", &error);
    }
}

// Queues a job. Rejects the job if another job with the same id is waiting or being drawn, because their answers could
// not be distinguished.
static void hold(struct batch_jobs *jobs, struct batch_job *job, uint64_t line)
{
    pthread_mutex_lock(&jobs->lock);
    bool twice = list_find(&jobs->waiting, job->id) || list_find(&jobs->drawing, job->id);
    jobs->held = twice ? NULL : job;
    pthread_mutex_unlock(&jobs->lock);
    lam_error error;
    if (!twice) {
        count(jobs, NULL, (size_t)job->plan.view_count);
        return;
    }
    complain(&error, LAM_BAD_ARGUMENT, "key 'id': another job with this id is waiting or being drawn");
    count(jobs, &error, 1);
    refuse(jobs, NULL, line, "refused", &error);
    batch_job_free(job);
}

static bool is_blank(const char *text, size_t size)
{
    size_t at = 0;
    while (at < size && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r'))
        at++;
    return at == size;
}

static void take_line(struct batch_jobs *jobs, const char *text, size_t size)
{
    struct batch_job *job;
    json_t *id;
    lam_error error = {0};
    uint64_t line = jobs->stream.line;
    char *made = NULL;
    if (is_blank(text, size))
        return;
    if (jobs->batch->options->batch.is_list) {
        bool ok = list_rows_take(&jobs->list, text, size, line, &made, &error);
        if (!ok) {
            count(jobs, &error, 1);
            refuse(jobs, NULL, line, "refused", &error);
        }
        if (!made)
            return;
        text = made;
        size = strlen(made);
    }
    switch (batch_job_read(text, size, &jobs->rules, &job, &id, &error)) {
    case LINE_JOB:
        hold(jobs, job, line);
        break;
    case LINE_CANCEL:
        cancel(jobs, id, line);
        break;
    case LINE_REFUSED:
        count(jobs, &error, 1);
        refuse(jobs, id, line, "refused", &error);
        break;
    }
    json_decref(id);
    free(made);
}

// Adds the held job to the queue if there is space.
static bool let_in(struct batch_jobs *jobs)
{
    pthread_mutex_lock(&jobs->lock);
    bool enters = jobs->held && has_room(jobs);
    if (enters) {
        list_add(&jobs->waiting, jobs->held);
        jobs->waiting_count++;
        jobs->waiting_bytes += jobs->held->bytes.size;
        jobs->held = NULL;
        pthread_cond_broadcast(&jobs->changed);
    }
    pthread_mutex_unlock(&jobs->lock);
    return enters;
}

// --- the end

static void give_up(struct batch_jobs *jobs)
{
    const char *why = interrupted() ? "interrupted" : "given up";
    pthread_mutex_lock(&jobs->lock);
    struct batch_job *held = jobs->held, *waiting = jobs->waiting.first;
    jobs->held = NULL;
    list_start(&jobs->waiting);
    jobs->waiting_count = jobs->waiting_bytes = 0;
    jobs->closed = jobs->given_up = true;
    for (struct batch_job *job = jobs->drawing.first; job; job = job->next) {
        job->cancelled = true;
        lam_cancel_raise(&job->cancel);
    }
    pthread_cond_broadcast(&jobs->changed);
    pthread_mutex_unlock(&jobs->lock);
    for (struct batch_job *next; waiting; waiting = next) {
        next = waiting->next;
        answer_cancelled(jobs, waiting, why);
    }
    if (held)
        answer_cancelled(jobs, held, why);
}

static void close_jobs(struct batch_jobs *jobs)
{
    pthread_mutex_lock(&jobs->lock);
    jobs->closed = true;
    pthread_cond_broadcast(&jobs->changed);
    pthread_mutex_unlock(&jobs->lock);
}

// Waits for workers to take or finish jobs. The caller holds the lock.
static void wait_changed(struct batch_jobs *jobs, int wait_ms)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += wait_ms * 1000000L;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&jobs->changed, &jobs->lock, &until);
}

static void pause_for(struct batch_jobs *jobs, int wait_ms, bool (*done)(const struct batch_jobs *jobs))
{
    pthread_mutex_lock(&jobs->lock);
    if (wait_ms && !done(jobs))
        wait_changed(jobs, wait_ms);
    pthread_mutex_unlock(&jobs->lock);
}

static bool never(const struct batch_jobs *jobs)
{
    (void)jobs;
    return false;
}

// Waits for input and reads it. Also detects whether the reader of the answers has closed the pipe.
static void read_more(struct batch_jobs *jobs, int wait_ms)
{
    struct pollfd wait[2] = {{.fd = jobs->stream.file, .events = POLLIN}, {.fd = STDOUT_FILENO}};
    lam_error error;
    if (poll(wait, 2, wait_ms) <= 0)
        return;
    if (wait[1].revents & POLLERR)
        job_answers_fail(&jobs->out, EPIPE);
    if (!wait[0].revents || job_stream_read(&jobs->stream))
        return;
    complain(&error, errno == ENOMEM ? LAM_MACHINE : LAM_CANNOT_READ, "the jobs cannot be read: %s", strerror(errno));
    batch_stop(jobs->batch, &error);
}

static bool is_failed(struct batch_jobs *jobs)
{
    lam_error error;
    struct batch *b = jobs->batch;
    int reason = job_answers_failure(&jobs->out);
    pthread_mutex_lock(&b->lock);
    bool failed = b->failed;
    pthread_mutex_unlock(&b->lock);
    if (!reason || failed)
        return failed;
    complain(&error, LAM_CANNOT_WRITE, "standard output: cannot write answers: %s", strerror(reason));
    batch_stop(b, &error);
    return true;
}

void batch_jobs_step(struct batch_jobs *jobs, int wait_ms)
{
    const char *text;
    size_t size;
    lam_error error;
    if (!jobs->given_up && (is_failed(jobs) || interrupted()))
        give_up(jobs);
    if (jobs->closed) {
        pause_for(jobs, wait_ms, never);
        return;
    }
    if (jobs->held) {
        if (!let_in(jobs))
            pause_for(jobs, wait_ms, has_room);
        return;
    }
    switch (job_stream_next(&jobs->stream, &text, &size)) {
    case JOB_LINE_WHOLE:
        take_line(jobs, text, size);
        let_in(jobs);
        break;
    case JOB_LINE_TOO_LONG:
        complain(&error, LAM_LIMIT, "longer than the limit of %zu bytes (--line-limit)", jobs->stream.limit);
        count(jobs, &error, 1);
        refuse(jobs, NULL, jobs->stream.line, "refused", &error);
        break;
    case JOB_LINE_NONE:
        if (jobs->stream.ended)
            close_jobs(jobs);
        else
            read_more(jobs, wait_ms);
        break;
    }
}

int batch_jobs_wanted(const struct batch_jobs *jobs) { return jobs->closed || jobs->held ? -1 : jobs->stream.file; }

bool batch_jobs_is_ready(const struct batch_jobs *jobs)
{
    const struct job_stream *s = &jobs->stream;
    bool line = s->ended || (s->data && memchr(s->data + s->start, '\n', s->end - s->start));
    return !jobs->closed && (jobs->held ? has_room(jobs) : line);
}

bool batch_jobs_waiting(struct batch_jobs *jobs)
{
    pthread_mutex_lock(&jobs->lock);
    bool waiting = jobs->waiting.first != NULL;
    pthread_mutex_unlock(&jobs->lock);
    return waiting;
}

bool batch_jobs_over(struct batch_jobs *jobs)
{
    pthread_mutex_lock(&jobs->lock);
    bool over = jobs->closed && !jobs->waiting.first;
    pthread_mutex_unlock(&jobs->lock);
    return over;
}

// --- workers

bool batch_jobs_take(struct batch_jobs *jobs, struct batch_task *task, bool waits)
{
    pthread_mutex_lock(&jobs->lock);
    while (waits && !jobs->waiting.first && !jobs->closed)
        pthread_cond_wait(&jobs->changed, &jobs->lock);
    struct batch_job *job = jobs->waiting.first;
    if (job) {
        list_remove(&jobs->waiting, job);
        jobs->waiting_count--;
        jobs->waiting_bytes -= job->bytes.size;
        list_add(&jobs->drawing, job);
        *task = (struct batch_task){.plan = &job->plan, .options_text = job->options_text, .job = job};
        pthread_cond_broadcast(&jobs->changed);
    }
    pthread_mutex_unlock(&jobs->lock);
    return job != NULL;
}

void batch_jobs_answer(struct batch_jobs *jobs, struct batch_work *work)
{
    struct batch_job *job = work->task.job;
    // Removes the job before sending the answer, because the reader of the answer may reuse the id immediately.
    pthread_mutex_lock(&jobs->lock);
    list_remove(&jobs->drawing, job);
    pthread_cond_broadcast(&jobs->changed);
    pthread_mutex_unlock(&jobs->lock);
    job_answer_work(&jobs->out, work);
    work->task = (struct batch_task){0};
    batch_job_free(job);
}
