// job_answer.c: writes the answers of --jobs.
#include "batch.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base64.h"
#include "batch_job.h"
#include "console.h"
#include "interrupt.h"
#include "journal.h"
#include "option_names.h"

// If poll() reports space in a pipe, writing this number of bytes (PIPE_BUF) does not block.
enum { CHUNK = 4096 };

// The longest wait for a reader after an interrupt.
static const double patience_ms = 500;

void job_answers_start(struct job_answers *answers)
{
    answers->failure = 0;
    pthread_mutex_init(&answers->lock, NULL);
}

void job_answers_end(struct job_answers *answers) { pthread_mutex_destroy(&answers->lock); }

int job_answers_failure(const struct job_answers *answers)
{
    return __atomic_load_n(&answers->failure, __ATOMIC_RELAXED);
}

void job_answers_fail(struct job_answers *answers, int reason)
{
    int none = 0;
    __atomic_compare_exchange_n(&answers->failure, &none, reason, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
}

// --- writing

// Waits until more bytes can be written. Returns false if, after an interrupt, no bytes could be written within
// patience_ms.
static bool wait_writable(double *since_ms)
{
    struct pollfd wait = {.fd = STDOUT_FILENO, .events = POLLOUT};
    while (poll(&wait, 1, 100) <= 0) {
        if (!interrupted())
            continue;
        *since_ms = *since_ms > 0 ? *since_ms : clock_ms();
        if (clock_ms() - *since_ms > patience_ms)
            return false;
    }
    return true;
}

static void write_text(struct job_answers *answers, const char *text, size_t size)
{
    double since_ms = 0;
    pthread_mutex_lock(&answers->lock);
    while (size && !job_answers_failure(answers)) {
        ssize_t wrote = -1;
        errno = EINTR;
        if (wait_writable(&since_ms))
            wrote = write(STDOUT_FILENO, text, size < CHUNK ? size : CHUNK);
        else
            job_answers_fail(answers, EPIPE);
        if (wrote < 0 && errno != EINTR && errno != EAGAIN)
            job_answers_fail(answers, errno);
        text += wrote > 0 ? wrote : 0;
        size -= wrote > 0 ? (size_t)wrote : 0;
    }
    pthread_mutex_unlock(&answers->lock);
}

static void put(struct job_answers *answers, json_t *answer)
{
    char *line = journal_line(answer);
    if (line)
        write_text(answers, line, strlen(line));
    else
        job_answers_fail(answers, ENOMEM);
    free(line);
    json_decref(answer);
}

// // --- the contents of answers

static json_t *start(json_t *id, const char *outcome)
{
    json_t *answer = json_object();
    json_object_set_new(answer, "id", id ? json_incref(id) : json_null());
    json_object_set_new(answer, "outcome", json_string(outcome));
    return answer;
}

static void set_class(json_t *answer, const struct exit_code *code, const char *error)
{
    json_object_set_new(answer, "class", json_string(code->name));
    json_object_set_new(answer, "exit", json_integer(code->code));
    char shown[MESSAGE_SIZE];
    journal_set_text(answer, "error", error ? name_options(error, shown) : NULL);
}

void job_answer_error(struct job_answers *answers, json_t *id, uint64_t line, const char *outcome,
                      const lam_error *error)
{
    json_t *answer = start(id, outcome);
    if (line)
        json_object_set_new(answer, "line", json_integer((json_int_t)line));
    set_class(answer, exit_code_of(error->code), error->text);
    put(answers, answer);
}

// Adds the picture's file as base64. Returns false if memory runs out.
static bool add_data(json_t *picture, const lam_bytes *bytes)
{
    size_t length = 0;
    char *text = bytes->data ? base64_encode(bytes->data, bytes->size, &length) : NULL;
    if (text)
        json_object_set_new(picture, "data", json_stringn_nocheck(text, length));
    free(text);
    return text || !bytes->data;
}

// Returns the result of the whole job.
static const char *outcome_of(const struct batch_work *u)
{
    bool same = true;
    for (int i = 0; i < u->picture_count; i++) {
        if (u->pictures[i].outcome == PICTURE_OPEN)
            return u->interrupted ? "cancelled" : "failed";
        if (u->pictures[i].outcome == PICTURE_FAILED)
            return "failed";
        same &= u->pictures[i].outcome == PICTURE_SAME;
    }
    return same ? "same" : "written";
}

// Returns the record of the first failed picture. The answer repeats the record's error class and message.
static const json_t *failed_record(const struct batch_work *u)
{
    for (int i = 0; i < u->picture_count; i++)
        if (u->records[i] && json_integer_value(json_object_get(u->records[i], "exit")))
            return u->records[i];
    return NULL;
}

static void set_whole(json_t *answer, const struct batch_work *u, const char *outcome)
{
    const json_t *failed = failed_record(u);
    lam_error error = {0};
    if (failed) {
        static const char *const shared[] = {"class", "exit", "error", "cause"};
        for (int i = 0; i < 4; i++)
            json_object_set_new(answer, shared[i], json_deep_copy(json_object_get(failed, shared[i])));
        return;
    }
    const char *model = u->task.plan->models[0].path;
    if (strcmp(outcome, "cancelled") == 0)
        complain(&error, LAM_CANCELLED, "%.400s: %s", model, interrupted() ? "interrupted" : "cancelled");
    else if (strcmp(outcome, "failed") == 0)
        complain(&error, LAM_MACHINE, "%.400s: out of memory", model);
    set_class(answer, exit_code_of(error.code), error.code ? error.text : NULL);
}

void job_answer_work(struct job_answers *answers, const struct batch_work *u)
{
    const char *outcome = outcome_of(u);
    json_t *answer = start(u->task.job->id, outcome), *list = u->picture_count > 1 ? json_array() : NULL;
    bool ok = answer != NULL;
    set_whole(answer, u, outcome);
    for (int i = 0; i < u->picture_count; i++) {
        json_t *picture = list ? json_object() : json_incref(answer);
        if (u->records[i])
            json_object_update(picture, u->records[i]);
        json_object_del(list ? picture : NULL, "id"); // a journal line may contain another job's id
        if (u->contents)
            ok = add_data(picture, &u->contents[i]) && ok;
        if (list)
            json_array_append_new(list, picture);
        else
            json_decref(picture);
    }
    json_object_set_new(answer, "id", json_incref(u->task.job->id));
    if (list)
        json_object_set_new(answer, "pictures", list);
    if (ok)
        put(answers, answer);
    else
        job_answers_fail(answers, ENOMEM);
}
