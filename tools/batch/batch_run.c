// batch_run.c: the loop over models: workers take the next model, draw it, and deliver the result.
//
// A worker is a thread with its own device. If there are enough models, each device draws with one thread. With
// --isolate, a separate process draws each model. Another thread reads files ahead of the workers, so that reading and
// drawing overlap. Messages are printed in the order of the models, but journal lines are written immediately.
#include "batch.h"

#include <fcntl.h>
#include <inttypes.h>
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include <lambent/path.h>

#include "batch_job.h"
#include "journal.h"
#include "batch_sandbox.h"
#include "batch_work.h"
#include "console.h"
#include "limit_options.h"
#include "interrupt.h"
#include "report.h"
#include "writer.h"

enum { WORKERS_MAX = 256 };

struct worker {
    struct batch *batch;
    int slot;
    struct options options; // the options of the batch, with this worker's number of threads
    lam_device *device;
    pthread_t thread;
};

// --- one worker

// Releases a device's memory after a large picture of a job, because the next job may belong to another user.
static void trim(struct worker *w)
{
    enum { KEPT = 128 << 20 };
    lam_frame_report report;
    lam_error error;
    lam_device_report(w->device, &report);
    if (report.memory_bytes <= KEPT)
        return;
    lam_device_free(w->device);
    w->device = device_option_make(&w->options, &error);
    if (!w->device)
        batch_stop(w->batch, &error);
}

static void draw_next(struct worker *w, const struct batch_task *task)
{
    struct batch *b = w->batch;
    struct batch_work work;
    lam_error error = {0};
    bool alone = b->plan->count == 1;
    struct batch_job *job = task->job;
    if (!batch_work_start(&work, b, task, &error)) {
        batch_stop(b, &error);
        return;
    }
    if (batch_work_look(&work, b)) {
        if (b->journal)
            journal_begin(b->journal, w->slot, (int)writer_process(), task->plan->models[task->model].path);
        batch_work_draw(&work, b, job ? &job->options : &w->options, w->device, job ? &job->cancel : NULL, !alone);
    }
    if (job)
        trim(w);
    batch_page_thumbnails(b, &work);
    batch_deliver(b, &work);
    batch_work_free(&work);
}

static void *work(void *user)
{
    struct worker *w = user;
    struct batch *b = w->batch;
    struct batch_task task;
    while (w->device && batch_take(b, &task, true))
        draw_next(w, &task);
    pthread_mutex_lock(&b->lock);
    b->drawing--;
    pthread_cond_broadcast(&b->changed);
    pthread_cond_broadcast(&b->moved);
    pthread_mutex_unlock(&b->lock);
    return NULL;
}

// --- reading ahead

// Asks the system to read a file into its page cache. Splits the request, because the system reads only the beginning
// of a long range.
static void warm(const char *path)
{
    enum { CHUNK = 128 << 10, MAX = 256 << 20 };
    int file = lam_path_open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    off_t end = file >= 0 ? lseek(file, 0, SEEK_END) : 0;
    for (off_t at = 0; at < end && at < MAX && !interrupted(); at += CHUNK)
        if (posix_fadvise(file, at, CHUNK, POSIX_FADV_WILLNEED) != 0)
            break;
    if (file >= 0)
        close(file);
}

// Reads files ahead of the workers. Each wake-up of this thread costs processor time and needs the lock, so with N
// workers, this thread wakes only once per N models.
static void *read_ahead(void *user)
{
    struct batch *b = user;
    size_t workers = (size_t)b->workers, ahead = 3 * workers + 2;
    pthread_mutex_lock(&b->lock);
    for (size_t at = 0; at < b->plan->count && b->drawing && !interrupted(); at++) {
        while (at > b->next + ahead && b->drawing) {
            b->read_from = at - ahead + workers;
            pthread_cond_wait(&b->moved, &b->lock);
        }
        if (at < b->next)
            at = b->next;
        if (at >= b->plan->count || b->taken[at])
            continue;
        pthread_mutex_unlock(&b->lock);
        warm(b->plan->models[at].path);
        pthread_mutex_lock(&b->lock);
    }
    pthread_mutex_unlock(&b->lock);
    return NULL;
}

// --- a pass

// Shows the progress while workers draw.
static void show_progress(struct batch *b)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += 100000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&b->changed, &b->lock, &until);
    batch_show_progress(&b->tally);
}

// Reads jobs while workers draw.
static void read_jobs(struct batch *b)
{
    pthread_mutex_unlock(&b->lock);
    batch_jobs_step(b->jobs, 100);
    pthread_mutex_lock(&b->lock);
}

// Waits while the workers draw. A single worker runs in this thread, unless there are jobs to read.
static void run_threads(struct batch *b, struct worker *workers)
{
    b->drawing = b->workers;
    if (b->workers == 1 && !b->jobs) {
        work(&workers[0]);
        return;
    }
    pthread_t reader;
    bool reads = b->plan->count > (size_t)b->workers && pthread_create(&reader, NULL, read_ahead, b) == 0;
    int started = 0;
    while (started < b->workers && pthread_create(&workers[started].thread, NULL, work, &workers[started]) == 0)
        started++;
    pthread_mutex_lock(&b->lock);
    b->drawing -= b->workers - started;
    while (b->drawing)
        (b->jobs ? read_jobs : show_progress)(b);
    pthread_cond_broadcast(&b->moved);
    pthread_mutex_unlock(&b->lock);
    for (int i = 0; i < started; i++)
        pthread_join(workers[i].thread, NULL);
    if (reads)
        pthread_join(reader, NULL);
    lam_error error;
    if (!started && b->jobs) {
        complain(&error, LAM_MACHINE, "cannot start a thread");
        batch_stop(b, &error);
    } else if (!started) { // no other thread started, so this thread draws
        b->drawing = 1;
        work(&workers[0]);
    }
}

static bool make_workers(struct batch *b, struct worker *workers, lam_error *error)
{
    for (int i = 0; i < b->workers; i++) {
        workers[i] = (struct worker){.batch = b, .slot = i, .options = *b->options};
        workers[i].options.work.threads = b->threads;
        workers[i].options.limits.in_flight = b->workers;
        workers[i].device = device_option_make(&workers[i].options, error);
        if (!workers[i].device)
            return false;
    }
    return true;
}

static void free_workers(const struct batch *b, struct worker *workers)
{
    for (int i = 0; i < b->workers; i++)
        lam_device_free(workers[i].device);
}

// Draws the models that a killed run was drawing, each in a separate process, because one of them may have crashed the
// run.
static void draw_suspects(struct batch *b)
{
    if (b->way == JOURNAL_START || !batch_begin_suspects(b))
        return;
    batch_isolate(b);
    batch_end_suspects(b);
}

static bool run_passes(struct batch *b, lam_error *error)
{
    struct worker *workers = b->options->batch.isolate ? NULL : calloc((size_t)b->workers, sizeof *workers);
    if (!workers && !b->options->batch.isolate)
        return complain(error, LAM_MACHINE, "out of memory");
    draw_suspects(b);
    bool ok = !workers || (batch_sandbox_enter(b, 0, b->plan->count, error) && make_workers(b, workers, error));
    for (int pass = 0; ok && (b->jobs ? pass == 0 : batch_begin_pass(b, pass)); pass++) {
        if (workers)
            run_threads(b, workers);
        else
            batch_isolate(b);
    }
    if (!b->journal && !b->options->batch.report_page && !b->use)
        writer_finish();
    if (workers)
        free_workers(b, workers);
    free(workers);
    return ok;
}

// --- the batch

// Chooses one worker per processor or, if there are fewer models than processors, one worker per model with several
// threads.
static void share_threads(struct batch *b)
{
    int threads = b->options->work.threads ? b->options->work.threads : lam_processors_available();
    int most = device_option_is_gl(b->options) ? 1 : threads < WORKERS_MAX ? threads : WORKERS_MAX;
    size_t models = b->options->batch.jobs ? (size_t)most : b->plan->count;
    b->workers = (size_t)most < models ? most : models ? (int)models : 1;
    b->threads = b->workers == 1 ? b->options->work.threads : threads / b->workers;
}

// Returns a string, allocated with malloc. The string first lists the options that apply to all pictures in the
// journal, and then the side and size of each picture that the run draws per model. Returns NULL if memory runs out.
static char *pictures_text(const struct batch *b)
{
    const struct batch_plan *plan = b->plan;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(out, "%soutput=%s\n", b->options_text,
            plan->pattern                ? plan->pattern
            : b->options->picture.output ? b->options->picture.output
                                         : "");
    if (plan->by_list) // if the size of the list changes, models move to other shards
        fprintf(out, "shard-by=list of %" PRIu64 " bytes\n", plan->list_bytes);
    for (int i = 0; i < plan->view_count; i++) {
        const struct job_view *v = &plan->views[i];
        fprintf(out, "picture=%s %dx%d%s%s\n", v->name, v->width, v->height, v->show, v->camera ? v->camera : "");
    }
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

static bool start(struct batch *b, const char *journal, lam_error *error)
{
    const struct options *o = b->options;
    size_t models = b->plan->count, pictures = models * (size_t)b->plan->view_count;
    share_threads(b);
    b->environments = o->batch.isolate ? NULL : environment_cache_make();
    b->pictures = calloc(pictures + 1, sizeof *b->pictures);
    b->taken = calloc(models + 1, sizeof *b->taken);
    b->texts = (struct batch_texts){.list = calloc(models + 1, sizeof *b->texts.list), .count = models};
    bool keeps = o->batch.report_page || b->use;
    b->records = keeps ? calloc(pictures + 1, sizeof *b->records) : NULL;
    if (!b->pictures || !b->taken || !b->texts.list || (keeps && !b->records))
        return complain(error, LAM_MACHINE, "out of memory");
    b->tally = (struct batch_tally){.shard = b->plan->shard,
                                    .total = pictures,
                                    .start_ms = clock_ms(),
                                    .has_progress = console_is_terminal() && !o->report.quiet && models > 1};
    if ((journal || o->batch.report_page) && !(b->options_text = batch_options_text(o, error)))
        return false;
    b->way = o->batch.skip_same ? JOURNAL_SAME : o->batch.resume ? JOURNAL_RESUME : JOURNAL_START;
    if (!batch_sandbox_make_folders(b, journal, error))
        return false;
    char *all = journal ? pictures_text(b) : NULL;
    bool ok = !journal || all || complain(error, LAM_MACHINE, "out of memory");
    char shard[32] = "";
    if (b->plan->shard.count)
        snprintf(shard, sizeof shard, "%d/%d", b->plan->shard.number, b->plan->shard.count);
    char *folder = journal ? batch_plan_folder(b->plan) : NULL;
    ok = ok && (!journal || folder || complain(error, LAM_MACHINE, "out of memory"));
    struct journal_run run = {all, folder, *shard ? shard : NULL, pictures};
    ok = ok && (!journal || (b->journal = journal_open(journal, b->way, &run, b->workers, error)));
    free(folder);
    free(all);
    return ok && (!o->batch.jobs || (b->jobs = batch_jobs_open(b, error)));
}

// Returns whether every picture has an outcome. If memory ran out, some pictures are still PICTURE_OPEN.
static bool has_every_outcome(const struct batch *b)
{
    size_t pictures = b->plan->count * (size_t)b->plan->view_count, i = 0;
    while (i < pictures && b->pictures[i].outcome != PICTURE_OPEN)
        i++;
    return i == pictures;
}

// Lists the pictures that failed repeatedly.
static void name_poison(const struct batch *b)
{
    enum { NAMES = 10 };
    size_t count = 0, pictures = b->plan->count * (size_t)b->plan->view_count;
    for (size_t i = 0; i < pictures; i++) {
        const struct batch_picture *picture = &b->pictures[i];
        bool failed = picture->outcome == PICTURE_FAILED || picture->outcome == PICTURE_FAILED_BEFORE;
        if (!failed || picture->attempts < 2 || count++ >= NAMES)
            continue;
        lam_error text;
        complain(&text, LAM_LIMIT, "%.400s: failed %d times and is not retried",
                 b->plan->models[i / (size_t)b->plan->view_count].path, picture->attempts);
        say_error(text.text);
    }
    if (count > NAMES)
        say_plain("lambent: and %zu more\n", count - NAMES);
}

static json_t *record_of(void *user, size_t picture) { return json_incref(((struct batch *)user)->records[picture]); }

static void finish(struct batch *b)
{
    batch_print_rest(&b->texts, &b->tally);
    lam_error error;
    if (b->use) {
        if (!interrupted() && !b->failed)
            b->code = b->use->finish(b->use->user, b->records, b->tally.failed);
        return;
    }
    struct batch_page page = {.path = b->options->batch.report_page,
                              .tally = &b->tally,
                              .record = record_of,
                              .user = b,
                              .own = true,
                              .record_count = b->plan->count * (size_t)b->plan->view_count};
    if (page.path && !batch_page_write(&page, &error))
        batch_stop(b, &error);
    if (!interrupted())
        name_poison(b);
    bool several = b->is_batch || b->plan->count > 1;
    if (several && !b->options->report.quiet && !b->options->report.json)
        batch_say_summary(&b->tally, interrupted());
}

static void free_batch(struct batch *b)
{
    size_t pictures = b->plan->count * (size_t)b->plan->view_count;
    for (size_t i = 0; b->records && i < pictures; i++)
        json_decref(b->records[i]);
    free(b->records);
    free(b->pictures);
    free(b->taken);
    free(b->texts.list);
    environment_cache_free(b->environments);
    free(b->options_text);
    pthread_cond_destroy(&b->changed);
    pthread_cond_destroy(&b->moved);
    pthread_mutex_destroy(&b->lock);
}

// Lets the process keep released memory for the next model. The system would clear returned memory before its next use,
// under a lock that all workers share. Keeping the memory saves 7 % of the processor time for pictures of 256 pixels.
static void keep_memory(void)
{
#ifdef __GLIBC__
    enum { MAPPED_FROM = 16 << 20, KEPT = 32 << 20, AT_ONCE = 1 << 20 };
    mallopt(M_MMAP_THRESHOLD, MAPPED_FROM);
    mallopt(M_TRIM_THRESHOLD, KEPT);
    mallopt(M_TOP_PAD, AT_ONCE);
#endif
}

static int run(const struct batch_plan *plan, const char *journal, bool is_batch, const struct batch_receiver *use)
{
    struct batch b = {.plan = plan, .options = plan->options, .is_batch = is_batch, .use = use};
    lam_error error = {0};
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&b.lock, NULL);
    pthread_cond_init(&b.changed, &monotonic);
    pthread_cond_init(&b.moved, NULL);
    pthread_condattr_destroy(&monotonic);
    interrupt_start();
    keep_memory();
    if (b.options->batch.jobs)
        signal(SIGPIPE, SIG_IGN); // if the reader of the answers closes the pipe, writing fails
    bool started = start(&b, journal, &error), ok = started && run_passes(&b, &error);
    if (started && ok)
        finish(&b);
    int code = !ok ? report_failure(&error, plan->options) : b.failed && is_batch ? b.stop_code : b.code;
    bool some_failed = ok && !use && !b.failed && b.tally.failed + b.tally.failed_before;
    if (some_failed && b.options->batch.failures_ok && !b.tally.by_machine && has_every_outcome(&b))
        code = 0;
    else if (some_failed && is_batch)
        code = EXIT_SOME_FAILED;
    journal_close(b.journal, ok && !interrupted() && !b.failed, code, interrupted());
    batch_jobs_close(b.jobs);
    // If the command draws only one model, reports an interrupt that arrived before the drawing began. The drawing
    // itself reports later interrupts.
    if (interrupted() && ok && !is_batch && plan->count == 1 && !b.interrupted &&
        b.pictures[0].outcome == PICTURE_OPEN) {
        complain(&error, LAM_CANCELLED, "%.400s: interrupted", plan->models[0].path);
        say_error(error.text);
    }
    free_batch(&b);
    if (interrupted())
        interrupt_finish();
    return code;
}

int batch_run(const struct batch_plan *plan, const char *journal, bool is_batch)
{
    const struct batch_shard *shard = &plan->shard;
    if (!shard->count)
        return run(plan, journal, is_batch, NULL);
    // Each shard writes its own journal and its own page.
    struct options options = *plan->options;
    struct batch_plan part = *plan;
    const char *page = options.batch.report_page;
    char *own_journal = journal ? batch_shard_path(journal, shard) : NULL;
    char *own_page = page ? batch_shard_path(page, shard) : NULL;
    lam_error error = {0};
    bool ok = ((own_journal || !journal) && (own_page || !page)) || complain(&error, LAM_MACHINE, "out of memory");
    ok = ok && (!journal || batch_shard_check_folder(journal, shard, &error));
    options.batch.report_page = own_page;
    part.options = &options;
    int code = ok ? run(&part, own_journal, is_batch, NULL) : report_failure(&error, plan->options);
    free(own_journal);
    free(own_page);
    return code;
}

int batch_receive(const struct batch_plan *plan, const struct batch_receiver *use)
{
    return run(plan, NULL, true, use);
}
