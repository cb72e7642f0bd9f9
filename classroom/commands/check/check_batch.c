// check_batch.c: checks many shaders in parallel and prints the results in order.
//
// Each thread takes the next submission, draws it in a separate process and compares the pictures. If this submission
// is the next to be printed, the thread prints its result and all following results that are ready.
#include "check.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"
#include "interrupt.h"
#include "output.h"

enum { MAX_TEXT_BYTES = 1 << 20, MAX_THREADS = 64, MAX_WAITING = 16 };
static const uint64_t default_memory_bytes = (uint64_t)1 << 30;

char *check_read_text(const char *path, lam_error *error)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    if (!file)
        return complain(error, LAM_CANNOT_READ, "%s: %s", path, strerror(errno)), NULL;
    char *text = malloc(MAX_TEXT_BYTES + 1);
    size_t size = text ? fread(text, 1, MAX_TEXT_BYTES + 1, file) : 0;
    bool bad = ferror(file);
    int reason = errno;
    if (!standard)
        fclose(file);
    if (!text)
        complain(error, LAM_MACHINE, "out of memory");
    else if (bad)
        complain(error, LAM_CANNOT_READ, "%s: %s", path, strerror(reason));
    else if (size > MAX_TEXT_BYTES)
        complain(error, LAM_LIMIT, "%s: the file is larger than %d bytes", path, MAX_TEXT_BYTES);
    else if (memchr(text, 0, size))
        complain(error, LAM_CANNOT_READ, "%s: expected text, found a zero byte", path);
    else {
        text[size] = 0;
        return text;
    }
    free(text);
    return NULL;
}

struct work {
    struct check_batch *b;
    pthread_mutex_t lock;
    pthread_cond_t printed_one;
    struct check_result **results; // for each submission, the result that is ready but not yet printed, or NULL
    int next, printed, passed, code;
    lam_error *first;
};

// --- one submission

// Writes the contract of a pair of shaders. A failure does not affect the verdict. The contract is useful even without
// a verdict. An existing file is kept, because somebody may have corrected it by hand.
static void write_contract(const char *path, const lam_check_params *params, struct check_result *result)
{
    lam_bytes text = {0};
    lam_error *error = &result->sheet_error;
    struct stat there;
    if (stat(path, &there) == 0 && S_ISREG(there.st_mode))
        complain(error, LAM_CANNOT_WRITE, "%s exists and is kept; remove it, or write the contract to another file",
                 path);
    else if (lam_check_contract_write(params, result->error.code ? NULL : &result->report, &text, error) &&
             output_make_folder(path, error))
        lam_bytes_save(&text, path, error);
    lam_bytes_free(&text);
}

static void run_check_of(struct check_batch *b, struct check_result *result)
{
    const struct options *o = b->options;
    const struct check_submission *s = result->submission;
    struct check_process process = {.time_limit_s = o->check.stop_after_s,
                                    .memory_limit_bytes = o->limits.memory_limit_bytes ? o->limits.memory_limit_bytes
                                                                                       : default_memory_bytes};
    lam_error *error = &result->error;
    if (s->problem) {
        complain(error, LAM_CANNOT_READ, "%s: %s", s->name.text, s->problem);
        return;
    }
    char *fragment = check_read_text(s->fragment, error),
         *vertex = fragment && s->vertex ? check_read_text(s->vertex, error) : NULL;
    if (fragment && (vertex || !s->vertex)) {
        lam_check_params params = {
            .fragment = fragment,
            .fragment_name = s->fragment,
            .vertex = vertex,
            .vertex_name = s->vertex,
            .contract = b->contract,
            .size = o->picture.has_size ? o->picture.width : 0,
            .tolerance = b->tolerance / 255,
            .light_frame = (lam_light_frame)o->check.light_frame,
            .reflection = (lam_reflection)o->check.highlight,
            .terms = (unsigned)o->check.terms,
            .max_pictures = option_given(o, "search-limit") ? (uint64_t)o->check.search_limit : 0,
            .scenes = b->scenes,
            .scene_count = b->scene_count,
            .cache = b->cache,
            .draw = check_process,
            .user = &process,
            .roles = b->roles,
            .explain_roles = o->check.explain_roles,
        };
        lam_check_run(&params, &result->report, error);
        if (o->check.write_contract)
            write_contract(o->check.write_contract, &params, result);
        if ((error->code == LAM_BAD_ARGUMENT || error->code == LAM_LIMIT) && !strstr(error->text, s->fragment)) {
            char text[sizeof error->text];
            snprintf(text, sizeof text, "%s", error->text);
            complain(error, error->code, "%s: %s", s->fragment, text);
        }
    }
    free(fragment);
    free(vertex);
}

// Writes the sheet and frees the pictures. The verdict is reported even if the sheet cannot be written.
static void write_sheet(struct check_batch *b, struct check_result *result)
{
    const struct options *o = b->options;
    lam_check_report *report = &result->report;
    if (o->picture.output && !b->without_sheets && report->scene_count) {
        int index = (int)(result->submission - b->submissions);
        result->sheet = check_sheet_path(o->picture.output, b->submissions, index, b->in_class);
        if (!result->sheet)
            complain(&result->sheet_error, LAM_MACHINE, "out of memory");
        else if (output_is_stream(result->sheet) ||
                 output_check(result->sheet, result->submission->fragment,
                              !b->in_class && output_is_named(o->picture.output), &result->sheet_error))
            check_sheet(report, result->submission->name.text, o, result->sheet, &result->sheet_error);
        if (result->sheet_error.code) {
            free(result->sheet);
            result->sheet = NULL;
        }
    }
    for (int i = 0; i < report->scene_count; i++) {
        lam_image_free(&report->scenes[i].theirs);
        lam_image_free(&report->scenes[i].reference);
    }
}

static struct check_result *check_one(struct check_batch *b, int index)
{
    struct check_result *result = calloc(1, sizeof *result);
    if (!result)
        return NULL;
    result->submission = &b->submissions[index];
    run_check_of(b, result);
    if (result->error.code)
        result->code = exit_code_of(result->error.code)->code;
    else {
        write_sheet(b, result);
        result->code = result->report.verdict == LAM_CHECK_PASSES ? 0 : EXIT_DIFFERS;
    }
    return result;
}

static void free_result(struct check_result *result)
{
    lam_check_report_free(&result->report);
    free(result->sheet);
    free(result);
}

// --- printing

static void print_report(const struct check_batch *b, const struct check_result *result)
{
    const struct options *o = b->options;
    FILE *file = result->sheet && strcmp(result->sheet, "-") == 0 ? stderr : stdout;
    if (o->report.json && (b->count > 1 || b->in_class || !result->error.code))
        check_report_json(file, result, b->in_class ? result->submission->name.text : NULL, b->tolerance);
    else if (!o->report.json && !o->report.quiet && b->in_class)
        check_report_line(file, result);
    else if (!o->report.json && !o->report.quiet && !result->error.code)
        check_report_text(file, &result->report, result->submission->fragment, b->tolerance);
    fflush(file); // shows each report immediately
}

static void print_result(struct work *w, const struct check_result *result)
{
    struct check_batch *b = w->b;
    bool alone = b->count == 1 && !b->in_class;
    if (result->error.code && alone)
        *w->first = result->error; // the caller reports the first error
    else if (result->error.code)
        say_error(result->error.text);
    print_report(b, result);
    int code = result->code;
    if (result->sheet_error.code) {
        int other = exit_code_of(result->sheet_error.code)->code;
        say_error(result->sheet_error.text);
        code = other > code ? other : code;
    }
    for (int i = 0; i < CHECK_TABLES; i++)
        if (b->tables[i].file && !b->tables[i].error)
            b->tables[i].error = b->tables[i].row(b->tables[i].file, result);
    if (b->page)
        check_page_add(b->page, result);
    w->passed += result->code == 0;
    w->code = code > w->code ? code : w->code;
}

// --- the threads

// Returns the next submission to check, or −1 if there is none. Blocks while too many finished results wait for a slow
// submission.
static int take_next(struct work *w)
{
    pthread_mutex_lock(&w->lock);
    while (w->next < w->b->count && w->next - w->printed >= MAX_WAITING + MAX_THREADS && !interrupted())
        pthread_cond_wait(&w->printed_one, &w->lock);
    int index = w->next < w->b->count && !interrupted() ? w->next++ : -1;
    pthread_mutex_unlock(&w->lock);
    return index;
}

static void store_result(struct work *w, int index, struct check_result *result)
{
    pthread_mutex_lock(&w->lock);
    w->results[index] = result;
    while (w->printed < w->b->count && w->results[w->printed] && !interrupted()) {
        print_result(w, w->results[w->printed]);
        free_result(w->results[w->printed]);
        w->results[w->printed++] = NULL;
    }
    pthread_cond_broadcast(&w->printed_one);
    pthread_mutex_unlock(&w->lock);
}

static void *check_next(void *work)
{
    struct work *w = work;
    for (int index; (index = take_next(w)) >= 0;) {
        struct check_result *result = check_one(w->b, index);
        if (!result) {
            pthread_mutex_lock(&w->lock);
            complain(w->first, LAM_MACHINE, "out of memory");
            pthread_mutex_unlock(&w->lock);
            return NULL;
        }
        store_result(w, index, result);
    }
    return NULL;
}

static int thread_count(const struct check_batch *b)
{
    int count = b->options->work.threads ? b->options->work.threads : lam_processors_available();
    count = count < MAX_THREADS ? count : MAX_THREADS;
    return count < b->count ? count : b->count;
}

int check_batch_run(struct check_batch *b, lam_error *first)
{
    struct work w = {.b = b, .first = first, .results = calloc((size_t)b->count, sizeof(struct check_result *))};
    if (!w.results) {
        complain(first, LAM_MACHINE, "out of memory");
        return exit_code_of(LAM_LIMIT)->code;
    }
    pthread_mutex_init(&w.lock, NULL);
    pthread_cond_init(&w.printed_one, NULL);
    pthread_t threads[MAX_THREADS];
    int wanted = thread_count(b), started = 0;
    while (started < wanted - 1 && pthread_create(&threads[started], NULL, check_next, &w) == 0)
        started++;
    check_next(&w);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    for (int i = 0; i < b->count; i++)
        if (w.results[i])
            free_result(w.results[i]);
    free(w.results);
    pthread_cond_destroy(&w.printed_one);
    pthread_mutex_destroy(&w.lock);
    if ((b->count > 1 || b->in_class) && !b->options->report.json && !b->options->report.quiet && !interrupted())
        printf("%d of %d pass\n", w.passed, b->count);
    return w.code;
}
