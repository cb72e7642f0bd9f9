// batch_work.c: processes one model of a batch.
#include "batch_job.h"
#include "journal.h"
#include "console.h"
#include "batch_work.h"
#include "report.h"
#include "xxh64.h"

#include <lambent/path.h>

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool batch_work_start(struct batch_work *u, const struct batch *b, const struct batch_task *task, lam_error *error)
{
    size_t count = (size_t)task->plan->view_count;
    bool in_answer = task->job && task->job->in_answer;
    *u = (struct batch_work){.task = *task,
                             .picture_count = task->plan->view_count,
                             .pictures = calloc(count, sizeof *u->pictures),
                             .outputs = calloc(count, sizeof *u->outputs),
                             .contents = in_answer ? calloc(count, sizeof *u->contents) : NULL,
                             .classes = calloc(count, sizeof *u->classes),
                             .records = calloc(count, sizeof *u->records),
                             .open = {calloc(count, sizeof *u->open.views), calloc(count, sizeof *u->open.outputs),
                                      calloc(count, sizeof *u->open.attempts), calloc(count, sizeof *u->open.which)},
                             .is_new = calloc(count, sizeof *u->is_new)};
    bool ok = u->pictures && u->outputs && u->classes && u->records && u->is_new && u->open.views && u->open.outputs &&
              u->open.attempts && u->open.which && (u->contents || !in_answer);
    for (size_t i = 0; ok && i < count; i++) {
        if (!task->job)
            u->pictures[i] = batch_pictures_of(b, task->model)[i];
        u->outputs[i] = batch_plan_output(task->plan, task->model, (int)i);
        ok = u->outputs[i] != NULL;
    }
    ok = ok && batch_plan_transforms(task->plan, task->model, &u->transforms);
    if (ok)
        return true;
    batch_work_free(u);
    return complain(error, LAM_MACHINE, "out of memory");
}

void batch_work_free(struct batch_work *u)
{
    for (int i = 0; i < u->picture_count; i++) {
        if (u->outputs)
            free(u->outputs[i]);
        if (u->contents)
            lam_bytes_free(&u->contents[i]);
        if (u->records)
            json_decref(u->records[i]);
    }
    free(u->pictures);
    free(u->outputs);
    free(u->contents);
    free(u->classes);
    free(u->records);
    free(u->is_new);
    free(u->transforms);
    free(u->open.views);
    free(u->open.outputs);
    free(u->open.attempts);
    free(u->open.which);
    free(u->out);
    free(u->err);
    *u = (struct batch_work){0};
}

// --- decisions by the journal

// Returns whether the picture exists and its hash equals the hash in the journal.
static bool is_untouched(const json_t *record, const char *output)
{
    uint64_t hash, recorded;
    return xxh64_parse(journal_value(record, "hash").text, &recorded) && xxh64_file(output, &hash) && hash == recorded;
}

// Returns the current path of a file that the record names, allocated with malloc. The record may come from a run in
// another folder. If the file was next to its model in that run, returns a path in the model's current folder. Returns
// NULL if memory runs out.
static char *path_now(const char *recorded, const char *recorded_model, const char *model)
{
    char *path = journal_path(recorded), *then = journal_path(recorded_model), *now = NULL;
    const char *slash = then ? strrchr(then, '/') : NULL, *own = strrchr(model, '/');
    size_t folder = slash ? (size_t)(slash - then) + 1 : 0;
    bool beside = path && then && strncmp(path, then, folder) == 0 && (folder || *path != '/');
    if (beside && strcmp(path, then) == 0)
        now = strdup(model);
    else if (!beside)
        now = path ? strdup(path) : NULL;
    else if (asprintf(&now, "%.*s%s", own ? (int)(own - model) + 1 : 0, model, path + folder) < 0)
        now = NULL;
    free(path);
    free(then);
    return now;
}

// Returns whether the key in the record still matches the model's files and the options.
static bool has_same_key(const json_t *record, const struct batch_work *u, int view)
{
    const json_t *files = json_object_get(record, "files"), *file;
    size_t count = json_array_size(files), i;
    const char *model = u->task.plan->models[u->task.model].path;
    uint64_t recorded;
    char(*hashes)[XXH64_TEXT] = calloc(count + 1, sizeof *hashes);
    const char **texts = calloc(count + 1, sizeof *texts);
    bool same = hashes && texts && xxh64_parse(journal_value(record, "key").text, &recorded);
    if (same)
        json_array_foreach(files, i, file)
        {
            uint64_t hash;
            char *path = path_now(journal_value(file, "path").text, journal_value(record, "model").text, model);
            texts[i] = hashes[i];
            if (path && xxh64_file(path, &hash))
                xxh64_print(hash, hashes[i]);
            else
                strcpy(hashes[i], "absent");
            same &= path && strcmp(hashes[i], journal_value(file, "hash").text) == 0;
            free(path);
        }
    if (same) {
        const struct batch_plan *plan = u->task.plan;
        const char *dot = strrchr(u->outputs[view], '.'), *format = journal_value(record, "format").text;
        struct batch_key_parts parts = {.options = u->task.options_text,
                                        .parsed = plan->options,
                                        .model = model,
                                        .format = strcmp(format, "shape") == 0 ? "" : format,
                                        .picture = dot ? dot + 1 : "",
                                        .view = &plan->views[view],
                                        .files = texts,
                                        .file_count = (int)count};
        same = batch_key(&parts) == recorded;
    }
    free(hashes);
    free(texts);
    return same;
}

static enum picture_outcome look(const struct batch_work *u, const struct batch *b, int view, const json_t *record,
                                 uint16_t *attempts)
{
    struct stat found;
    bool written = strcmp(journal_value(record, "class").text, "ok") == 0;
    if (b->way == JOURNAL_SAME)
        return written && has_same_key(record, u, view) && is_untouched(record, u->outputs[view]) ? PICTURE_SAME
                                                                                                  : PICTURE_OPEN;
    if (written) {
        bool whole = lam_path_stat(u->outputs[view], &found) == 0 &&
                     found.st_size == json_integer_value(json_object_get(record, "bytes"));
        return whole ? PICTURE_BEFORE : PICTURE_OPEN;
    }
    // Lambent 0.1 before 2026-12 recorded no cause: a limit or a failed write may then be the machine's.
    int exit = (int)json_integer_value(json_object_get(record, "exit"));
    const char *cause = journal_value(record, "cause").text;
    bool by_machine = *cause ? strcmp(cause, "machine") == 0 : exit == 4 || exit == 5;
    *attempts = (uint16_t)json_integer_value(json_object_get(record, "attempt"));
    return by_machine || *attempts <= b->options->batch.retry_failed ? PICTURE_OPEN : PICTURE_FAILED_BEFORE;
}

bool batch_work_look(struct batch_work *u, const struct batch *b)
{
    bool open = false;
    for (int i = 0; i < u->task.plan->view_count; i++) {
        struct batch_picture *picture = &u->pictures[i];
        // A model that this run has already tried is retried regardless of the journal.
        bool asks = picture->outcome == PICTURE_OPEN && picture->attempts == 0 && b->journal &&
                    b->way != JOURNAL_START && !u->contents;
        json_t *record = asks ? journal_find(b->journal, u->outputs[i]) : NULL;
        if (record)
            picture->outcome = (uint8_t)look(u, b, i, record, &picture->attempts);
        if (picture->outcome != PICTURE_OPEN && (b->records || u->task.job))
            u->records[i] = record;
        else
            json_decref(record);
        open |= picture->outcome == PICTURE_OPEN;
    }
    return open;
}

// --- drawing

// Makes a drawing from the open pictures of a model.
static struct batch_drawing drawing_of(struct batch_work *u, const struct batch *b, const struct options *o)
{
    int count = 0;
    const struct batch_task *task = &u->task;
    for (int i = 0; i < task->plan->view_count; i++) {
        if (u->pictures[i].outcome != PICTURE_OPEN)
            continue;
        u->open.views[count] = task->plan->views[i];
        u->open.outputs[count] = u->outputs[i];
        u->open.attempts[count] = u->pictures[i].attempts + 1;
        u->open.which[count++] = i;
    }
    return (struct batch_drawing){.options = o,
                                  .options_text = task->options_text,
                                  .has_records = b->options_text || task->job || b->use,
                                  .model = task->plan->models[task->model].path,
                                  .model_bytes = task->job && task->job->bytes.data ? &task->job->bytes : NULL,
                                  .views = u->open.views,
                                  .outputs = u->open.outputs,
                                  .contents = u->contents, // if this is not NULL, all pictures of the model are open
                                  .makes_folders = task->job != NULL,
                                  .attempts = u->open.attempts,
                                  .view_count = count,
                                  .use = b->use,
                                  .index = task->model,
                                  // if some pictures were drawn before, the file is complete
                                  .transforms = count == task->plan->view_count && !u->contents ? u->transforms : NULL,
                                  .one_of_many = task->plan->count > 1,
                                  .several = o->batch.view_count || o->batch.size_count || o->batch.show_count};
}

void batch_work_draw(struct batch_work *u, const struct batch *b, const struct options *o, lam_device *device,
                     const lam_cancel *cancel, bool capture)
{
    const int *which = u->open.which;
    struct batch_drawing drawing = drawing_of(u, b, o);
    drawing.cancel = cancel;
    struct batch_artist artist = {.device = device,
                                  .environments = b->environments,
                                  .out = stdout,
                                  .has_bar = !capture,
                                  .warns = !b->is_batch || b->use || o->report.verbose,
                                  .is_talkative = !b->is_batch || o->report.verbose};
    size_t out_size, err_size;
    FILE *out = capture ? open_memstream(&u->out, &out_size) : NULL,
         *err = capture ? open_memstream(&u->err, &err_size) : NULL;
    if (out)
        artist.out = out;
    console_capture(err);
    struct batch_result result;
    batch_draw(&drawing, &artist, &result);
    console_capture(NULL);
    if (out)
        fclose(out);
    if (err)
        fclose(err);
    u->code = result.code;
    u->warnings = result.warnings;
    u->interrupted = result.interrupted;
    for (int i = 0; i < result.record_count; i++) {
        struct batch_picture *picture = &u->pictures[which[i]];
        if (result.outcomes[i].kind == BATCH_INTERRUPTED)
            continue;
        u->classes[which[i]] = result.outcomes[i].class;
        picture->outcome = result.outcomes[i].kind == BATCH_WRITTEN ? PICTURE_WRITTEN : PICTURE_FAILED;
        picture->by_machine = result.outcomes[i].by_machine;
        picture->attempts++;
        u->records[which[i]] = result.records[i];
        u->is_new[which[i]] = true;
        result.records[i] = NULL;
    }
    batch_result_free(&result);
}

void batch_work_fail(struct batch_work *u, const struct batch *b, const char *class, int exit, bool by_machine,
                     const char *text)
{
    const int *which = u->open.which;
    struct batch_drawing drawing = drawing_of(u, b, u->task.plan->options);
    u->code = exit;
    for (int i = 0; i < drawing.view_count; i++) {
        struct batch_picture *picture = &u->pictures[which[i]];
        picture->outcome = PICTURE_FAILED;
        picture->attempts++;
        picture->by_machine = by_machine && picture->attempts < ATTEMPTS_OF_MACHINE;
        u->classes[which[i]] = class;
        u->records[which[i]] =
            drawing.has_records ? batch_record_failed(&drawing, i, class, exit, picture->by_machine, text) : NULL;
        u->is_new[which[i]] = true;
    }
}

// --- the state of a batch.

void batch_stop(struct batch *b, const lam_error *error)
{
    pthread_mutex_lock(&b->lock);
    int code = exit_code_of(error->code)->code;
    if (!b->failed) {
        batch_hide_progress(&b->tally);
        say_error(error->text);
    }
    b->stop_code = b->failed ? b->stop_code : code;
    b->failed = true;
    b->code = code > b->code ? code : b->code;
    pthread_mutex_unlock(&b->lock);
}
