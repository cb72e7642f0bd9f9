// batch_pass.c: runs one pass over the models.
#include "batch.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/path.h>

#include "batch_job.h"
#include "console.h"
#include "host_name.h"
#include "interrupt.h"

// --- selecting the next model

// Marks the failed pictures of a model as open if they may be retried. Returns whether any picture was marked.
static bool reopen(struct batch *b, size_t model)
{
    bool open = false;
    for (int i = 0; i < b->plan->view_count; i++) {
        struct batch_picture *picture = &batch_pictures_of(b, model)[i];
        if (picture->outcome == PICTURE_FAILED && picture->attempts <= b->options->batch.retry_failed) {
            picture->outcome = PICTURE_OPEN;
            b->tally.failed--;
            b->tally.retried--;
            b->tally.by_machine -= picture->by_machine;
            b->tally.classes[picture->class].count--;
            open = true;
        }
    }
    return open;
}

bool batch_begin_pass(struct batch *b, int pass)
{
    size_t count = 0;
    if (interrupted() || b->failed)
        return false;
    b->next = b->read_from = 0;
    for (size_t i = 0; i < b->plan->count; i++) {
        if (pass > 0)
            b->taken[i] = !reopen(b, i);
        count += !b->taken[i];
    }
    return count > 0;
}

bool batch_take(struct batch *b, struct batch_task *task, bool waits)
{
    if (b->jobs)
        return batch_jobs_take(b->jobs, task, waits);
    pthread_mutex_lock(&b->lock);
    while (b->next < b->plan->count && b->taken[b->next])
        b->next++;
    bool found = b->next < b->plan->count && !interrupted() && !b->failed;
    if (found) {
        *task = (struct batch_task){.plan = b->plan, .model = b->next++, .options_text = b->options_text};
        b->taken[task->model] = true;
        if (b->next >= b->read_from)
            pthread_cond_signal(&b->moved);
    }
    pthread_mutex_unlock(&b->lock);
    return found;
}

// --- leftovers of a killed run

// Returns whether a name is a temporary name of file_write.c: ".lambent-PROCESS-HOST-TIME.part".
static bool is_part(const char *name, const char *begin)
{
    size_t length = strlen(begin);
    return strncmp(name, begin, length) == 0 &&
           strcmp(name + length + strspn(name + length, "0123456789abcdef"), ".part") == 0;
}

void batch_remove_parts(const struct batch_plan *plan, size_t model, int process, const char *host)
{
    char begin[40 + HOST_SIZE], here[HOST_SIZE];
    snprintf(begin, sizeof begin, ".lambent-%d-%s-", process, host ? host : host_name(here));
    for (int i = 0; i < plan->view_count; i++) {
        char *output = batch_plan_output(plan, model, i), *slash = output ? strrchr(output, '/') : NULL;
        if (slash)
            slash[slash == output] = 0;
        DIR *folder = output ? lam_path_list(slash ? output : ".") : NULL;
        for (struct dirent *entry; folder && (entry = readdir(folder));)
            if (is_part(entry->d_name, begin))
                unlinkat(dirfd(folder), entry->d_name, 0);
        if (folder)
            closedir(folder);
        free(output);
    }
}

struct suspects {
    struct batch *batch;
    size_t count;
};

static void note_suspect(void *user, const char *model, int process, const char *host)
{
    struct suspects *s = user;
    struct batch *b = s->batch;
    for (size_t i = 0; i < b->plan->count; i++)
        if (strcmp(b->plan->models[i].path, model) == 0) {
            batch_remove_parts(b->plan, i, process, host);
            s->count += b->taken[i];
            b->taken[i] = false;
        }
}

bool batch_begin_suspects(struct batch *b)
{
    struct suspects suspects = {.batch = b};
    if (!b->journal)
        return false;
    memset(b->taken, 1, b->plan->count * sizeof *b->taken);
    journal_each_running(b->journal, note_suspect, &suspects);
    b->next = 0;
    if (!suspects.count) {
        memset(b->taken, 0, b->plan->count * sizeof *b->taken);
        return false;
    }
    return true;
}

// Marks all models without open pictures as taken, so that the next pass draws only the other models.
void batch_end_suspects(struct batch *b)
{
    for (size_t i = 0; i < b->plan->count; i++) {
        b->taken[i] = true;
        for (int k = 0; k < b->plan->view_count; k++)
            b->taken[i] &= batch_pictures_of(b, i)[k].outcome != PICTURE_OPEN;
    }
}

// --- results

enum { MACHINE_FAILURES = 10 }; // after this many in succession, the run stops

static void count(struct batch *b, const struct batch_work *u, int view)
{
    struct batch_tally *t = &b->tally;
    struct batch_picture *picture = &u->pictures[view];
    const char *class = u->classes[view];
    switch ((enum picture_outcome)picture->outcome) {
    case PICTURE_OPEN:
        break;
    case PICTURE_WRITTEN:
        t->written++;
        t->by_machine_in_row = 0;
        break;
    case PICTURE_SAME:
        t->same++;
        break;
    case PICTURE_BEFORE:
        t->before++;
        break;
    case PICTURE_FAILED:
        t->failed++;
        t->by_machine += picture->by_machine;
        t->by_machine_in_row += picture->by_machine;
        t->retried += picture->attempts <= b->options->batch.retry_failed;
        picture->class = (uint8_t)batch_count_class(t, class ? class : "failed");
        break;
    case PICTURE_FAILED_BEFORE:
        t->failed_before++;
        break;
    }
}

// Stores the new state of a picture, and its record for the page.
static void keep(struct batch *b, struct batch_work *u, int view)
{
    size_t at = u->task.model * (size_t)b->plan->view_count + (size_t)view;
    b->pictures[at] = u->pictures[view];
    if (b->records && u->records[view]) {
        json_decref(b->records[at]);
        b->records[at] = u->records[view];
        u->records[view] = NULL;
    }
}

void batch_deliver(struct batch *b, struct batch_work *u)
{
    lam_error error = {0};
    bool ok = true;
    const struct batch_job *job = u->task.job;
    pthread_mutex_lock(&b->lock);
    for (int i = 0; i < u->picture_count; i++) {
        uint8_t before = job ? PICTURE_OPEN : batch_pictures_of(b, u->task.model)[i].outcome;
        if (before != u->pictures[i].outcome)
            count(b, u, i);
        if (job && u->pictures[i].outcome == PICTURE_OPEN)
            b->tally.cancelled++;
        if (job && u->is_new[i] && u->records[i])
            json_object_set(u->records[i], "id", job->id);
        if (b->journal && u->is_new[i] && u->records[i] && ok)
            ok = journal_add(b->journal, u->records[i], &error);
        if (!job)
            keep(b, u, i);
    }
    b->tally.warnings += (size_t)u->warnings;
    if (job) { // the answer contains the job's errors
        if (b->options->report.verbose && u->err)
            fputs(u->err, stderr);
    } else {
        b->code = u->code > b->code ? u->code : b->code;
        b->interrupted |= u->interrupted;
        batch_print(&b->texts, u->task.model, u->out, u->err, u->code == 0, &b->tally);
        u->out = u->err = NULL;
    }
    batch_show_progress(&b->tally);
    bool stuck = !job && b->is_batch && b->tally.by_machine_in_row >= MACHINE_FAILURES;
    pthread_mutex_unlock(&b->lock);
    if (ok && stuck)
        ok = complain(&error, LAM_CANNOT_WRITE,
                      "%d pictures in succession failed because of this machine, not because of their models; mend the "
                      "cause and repeat the command with --resume",
                      MACHINE_FAILURES);
    if (!ok)
        batch_stop(b, &error);
    if (job)
        batch_jobs_answer(b->jobs, u);
}
