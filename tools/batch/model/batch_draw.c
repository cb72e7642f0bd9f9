// batch_draw.c: draws one model, and records the results of its pictures.
#include "batch_work.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include <lambent/path.h>

#include "animate_frame.h"
#include "journal.h"
#include "console.h"
#include "interrupt.h"
#include "limit_options.h"
#include "option_names.h"
#include "output.h"
#include "report.h"
#include "page.h"
#include "transforms.h"
#include "sandbox_start.h"
#include "xxh64.h"

// --- messages

static const char nothing_seen[] = "the picture shows no part of the model";

static bool sees_nothing(const struct job *job)
{
    const lam_frame_report *frame = &job->times.frame;
    return job->written && !frame->pixels_covered && !frame->edges_drawn;
}

// Returns whether a message begins with the name and a colon. In the message, '?' replaces each control character of
// the name.
static bool names(const char *sentence, const char *name)
{
    for (; *name; name++, sentence++) {
        bool control = (unsigned char)*name < 32 || *name == 127;
        if (*sentence != (control ? '?' : *name))
            return false;
    }
    return *sentence == ':';
}

// Adds the model's name to an error message that lacks the name. After a timeout, the message names the limit that the
// user set, not the time that remained for one step.
static void name_model(const struct job *job, lam_error *error)
{
    const struct options *o = job->options;
    const char *name = strcmp(job->model, "-") == 0 ? "standard input" : job->model;
    if (error->code == LAM_LIMIT && limits_time(o) > 0 && clock_ms() - job->times.start >= limits_time(o) * 1e3) {
        complain(error, LAM_LIMIT, "%s: the time limit of %.10g s was reached (--time-limit)", name, limits_time(o));
    } else if (error->code == LAM_CANCELLED) {
        complain(error, LAM_CANCELLED, "%s: %s", name, interrupted() ? "interrupted" : "cancelled");
    } else if (error->code != LAM_CANNOT_WRITE && !names(error->text, name) &&
               !((o->shape.parametric || o->shape.implicit) && strncmp(error->text, "option '", 8) == 0) &&
               !(job->output && strstr(error->text, job->output) == error->text)) {
        lam_error plain = *error;
        complain(error, plain.code, "%.200s: %.300s", name, plain.text);
    }
}

// --- records

bool batch_is_by_machine(const lam_error *error)
{
    return error->code == LAM_MACHINE || error->code == LAM_CANNOT_WRITE;
}

// The files of a model and their hashes.
struct files {
    int count;
    char (*hashes)[XXH64_TEXT];
    const char **texts; // the hashes as text
    bool changed;       // a file has changed since it was read, so the hashes are not valid
};

// Returns whether a file may have changed since `start`, a time on the clock that file systems use.
static bool changed_since(const char *path, const struct timespec *start)
{
    struct stat about;
    if (lam_path_stat(path, &about) != 0)
        return errno != ENOENT && errno != ENOTDIR;
    return about.st_ctim.tv_sec > start->tv_sec ||
           (about.st_ctim.tv_sec == start->tv_sec && about.st_ctim.tv_nsec >= start->tv_nsec);
}

// Returns whether somebody has set the clock since `start`, which was at `start_ms` on the clock that nobody sets.
static bool is_set(const struct timespec *start, double start_ms)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME_COARSE, &now);
    double seconds = (double)(now.tv_sec - start->tv_sec) + (double)(now.tv_nsec - start->tv_nsec) * 1e-9;
    double error_s = seconds - (clock_ms() - start_ms) * 1e-3;
    return error_s > 0.5 || error_s < -0.5;
}

static bool hash_files(const struct job *job, const struct timespec *start, double start_ms, struct files *files)
{
    while (lam_scene_file(job->scene, files->count))
        files->count++;
    files->hashes = calloc((size_t)files->count + 1, sizeof *files->hashes);
    files->texts = calloc((size_t)files->count + 1, sizeof *files->texts);
    if (!files->hashes || !files->texts)
        return false;
    for (int i = 0; i < files->count; i++) {
        uint64_t hash;
        const char *path = lam_scene_file(job->scene, i);
        files->texts[i] = files->hashes[i];
        if (xxh64_file(path, &hash))
            xxh64_print(hash, files->hashes[i]);
        else
            snprintf(files->hashes[i], XXH64_TEXT, "absent");
        files->changed |= changed_since(path, start);
    }
    files->changed |= is_set(start, start_ms);
    return true;
}

static void set_ms(json_t *record, const char *key, double ms)
{
    json_object_set_new(record, key, json_real((double)(int64_t)(ms * 1e3 + 0.5) / 1e3));
}

static json_t *start_record(const struct batch_drawing *drawing, int view, const char *class, int exit, bool by_machine,
                            const char *error)
{
    const struct job_view *v = &drawing->views[view];
    json_t *record = json_object();
    journal_set_text(record, "model", drawing->model);
    journal_set_text(record, "output", drawing->contents ? NULL : drawing->outputs[view]);
    journal_set_text(record, "view", v->name);
    journal_set_text(record, "class", class);
    json_object_set_new(record, "exit", json_integer(exit));
    char shown[MESSAGE_SIZE];
    journal_set_text(record, "error", error ? name_options(error, shown) : NULL);
    if (exit)
        journal_set_text(record, "cause", by_machine ? "machine" : "model");
    json_object_set_new(record, "attempt", json_integer(drawing->attempts[view]));
    return record;
}

json_t *batch_record_failed(const struct batch_drawing *drawing, int view, const char *name, int exit, bool by_machine,
                            const char *text)
{
    return start_record(drawing, view, name, exit, by_machine, text);
}

static json_t *warnings_of(const struct job *job)
{
    json_t *list = json_array();
    char shown[MESSAGE_SIZE];
    for (int i = 0; job->scene && lam_scene_warning(job->scene, i); i++) {
        char *clean = journal_text(name_options(lam_scene_warning(job->scene, i), shown));
        json_array_append_new(list, json_string(clean ? clean : ""));
        free(clean);
    }
    if (sees_nothing(job))
        json_array_append_new(list, json_string(nothing_seen));
    return list;
}

static json_t *times_of(const struct job_times *times)
{
    json_t *record = json_object();
    set_ms(record, "read", times->read);
    set_ms(record, "prepare", times->prepare);
    set_ms(record, "camera", times->camera);
    set_ms(record, "frame", times->frame.total_ms);
    set_ms(record, "encode", times->encode);
    set_ms(record, "total", times->total);
    return record;
}

static void add_hash(json_t *record, const struct batch_drawing *drawing, int view, const struct job *job)
{
    char text[XXH64_TEXT];
    uint64_t hash;
    if (drawing->contents)
        hash = xxh64_of(drawing->contents[view].data, drawing->contents[view].size);
    else if (!xxh64_file(job->output, &hash))
        return;
    xxh64_print(hash, text);
    journal_set_text(record, "hash", text);
}

// Adds the key and the files that were read to a record.
static void add_key(json_t *record, const struct batch_drawing *drawing, int view, const struct job *job,
                    const struct files *files)
{
    char text[XXH64_TEXT];
    const char *format = lam_scene_format(job->scene);
    json_t *list = json_array();
    for (int i = 0; i < files->count; i++) {
        json_t *file = json_object();
        journal_set_text(file, "path", lam_scene_file(job->scene, i));
        journal_set_text(file, "hash", files->texts[i]);
        json_array_append_new(list, file);
    }
    json_object_set_new(record, "files", list);
    if (files->changed || drawing->model_bytes || strcmp(drawing->model, "-") == 0)
        return; // a picture without a key is always drawn again
    struct batch_key_parts parts = {.options = drawing->options_text,
                                    .parsed = drawing->options,
                                    .model = drawing->model,
                                    .format = format,
                                    .picture = job->format,
                                    .view = &drawing->views[view],
                                    .files = files->texts,
                                    .file_count = files->count};
    xxh64_print(batch_key(&parts), text);
    journal_set_text(record, "key", text);
}

static json_t *record_of(const struct batch_drawing *drawing, int view, const struct job *job, const lam_error *error,
                         const struct files *files)
{
    const struct exit_code *code = exit_code_of(error->code);
    json_t *record = start_record(drawing, view, code->name, code->code, batch_is_by_machine(error),
                                  error->code ? error->text : NULL);
    if (job->scene) {
        json_object_set_new(record, "triangles", json_integer((json_int_t)job->model_counts.triangles));
        json_object_set_new(record, "lines", json_integer((json_int_t)job->model_counts.lines));
        json_object_set_new(record, "points", json_integer((json_int_t)job->model_counts.points));
    }
    char sandbox[SANDBOX_TEXT_SIZE];
    journal_set_text(record, "sandbox", sandbox_text(sandbox_active(), sandbox));
    json_object_set_new(record, "warnings", warnings_of(job));
    json_object_set_new(record, "times_ms", times_of(&job->times));
    if (job->written) {
        json_object_set_new(record, "width", json_integer(job->image.width));
        json_object_set_new(record, "height", json_integer(job->image.height));
        json_object_set_new(record, "bytes", json_integer((json_int_t)job->bytes));
        const char *format = lam_scene_format(job->scene);
        journal_set_text(record, "format", *format ? format : "shape");
        add_hash(record, drawing, view, job);
        if (drawing->options_text)
            add_key(record, drawing, view, job, files);
    }
    return record;
}

// --- drawing

// The state of drawing one model.
struct model_run {
    const struct batch_drawing *drawing;
    const struct batch_artist *artist;
    struct batch_result *result;
    struct timespec start; // by the clock that file systems use
    double start_ms;
    struct files files;
    int warnings; // the number of the scene's warnings after the previous picture
    bool hashed;
    json_t *found; // the data that batch_receiver.draw adds to the record; NULL if the picture is written to a file
};

// Prints and records the result of a picture.
static void finish_picture(struct model_run *r, struct job *job, int view, bool ok, lam_error *error)
{
    const struct options *o = r->drawing->options;
    FILE *stream = report_stream(o);
    bool may_talk = stream != stderr;
    job->times.total = clock_ms() - job->times.start;
    if (!ok)
        name_model(job, error);
    bool speaks = !o->report.quiet && may_talk, warns = speaks && r->artist->warns;
    bool talks = speaks && r->artist->is_talkative;
    r->result->warnings += job_say_warnings(job, &r->warnings, warns);
    if (sees_nothing(job)) {
        r->result->warnings++;
        if (warns)
            say_warning(nothing_seen);
    }
    if (!ok && may_talk)
        say_error(error->text);
    if (ok && o->report.dry_run && !stream && !o->report.quiet)
        report_plan(r->artist->out, job);
    else if (ok && o->report.verbose && may_talk && !o->report.dry_run)
        report_table(job);
    else if (ok && talks && !stream && !o->report.dry_run)
        report_line(job);
    if (stream)
        report_json(stream == stdout ? r->artist->out : stream, job, error);
    const struct exit_code *code = exit_code_of(error->code);
    r->result->code = code->code > r->result->code ? code->code : r->result->code;
    r->result->interrupted |= error->code == LAM_CANCELLED;
    r->result->outcomes[view].class = code->name;
    r->result->outcomes[view].by_machine = batch_is_by_machine(error);
    r->result->outcomes[view].kind = ok                             ? BATCH_WRITTEN
                                     : error->code == LAM_CANCELLED ? BATCH_INTERRUPTED
                                                                    : BATCH_FAILED;
    if (!r->drawing->has_records || error->code == LAM_CANCELLED)
        return;
    if (job->written && r->drawing->options_text && !r->hashed) {
        r->hashed = true;
        r->files.changed |= !hash_files(job, &r->start, r->start_ms, &r->files);
    }
    r->result->records[view] = record_of(r->drawing, view, job, error, &r->files);
    if (r->found)
        json_object_update(r->result->records[view], r->found);
}

static void run_views(struct model_run *r, struct job *job, struct progress *progress)
{
    lam_error error = {0};
    job->output = r->drawing->outputs[0];
    bool read = (!page_wanted(job) || page_refuse_several(&error)) && job_load(job, progress, &error) &&
                job_arrange(job, progress, &error);
    if (read && r->drawing->transforms && !job->options->report.dry_run)
        read = transforms_write(job, r->drawing->transforms, r->drawing->outputs, &error);
    for (int i = 0; i < job->view_count; i++) {
        job->output = r->drawing->outputs[i];
        job->picture_bytes = r->drawing->contents ? &r->drawing->contents[i] : NULL;
        bool ok = read && job_run_view(job, i, progress, &error);
        progress_end(progress);
        finish_picture(r, job, i, ok, &error);
        lam_image_free(&job->image);
        if (read)
            error = (lam_error){0};
        job->times.start = clock_ms();
        job->times.read = job->times.prepare = job->times.camera = 0;
    }
}

static void draw(struct model_run *r)
{
    const struct batch_drawing *drawing = r->drawing;
    struct options own = *drawing->options; // several sizes on the command line are treated like --size
    own.picture.has_size |= own.batch.size_count > 0;
    struct job job = {.options = drawing->several ? &own : drawing->options,
                      .model = drawing->model,
                      .model_bytes = drawing->model_bytes,
                      .picture_bytes = drawing->contents,
                      .one_of_many = drawing->one_of_many,
                      .makes_folder = drawing->makes_folders,
                      .cancel = drawing->cancel,
                      .device = r->artist->device,
                      .environments = r->artist->environments};
    job.times.start = clock_ms();
    clock_gettime(CLOCK_REALTIME_COARSE, &r->start);
    r->start_ms = clock_ms();
    struct progress progress;
    progress_start(&progress, drawing->model,
                   console_is_terminal() && r->artist->has_bar && !own.report.quiet && report_stream(&own) != stderr);
    if (drawing->several) {
        job.views = drawing->views;
        job.view_count = drawing->view_count;
        run_views(r, &job, &progress);
    } else {
        lam_error error = {0};
        job.output = drawing->outputs[0];
        const struct batch_receiver *use = drawing->use;
        r->found = use ? json_object() : NULL;
        bool ok = use ? use->draw(use->user, drawing->index, &job, &progress, r->found, &error)
                  : animation_wanted(job.options) ? animation_run(&job, &progress, &error)
                  : page_wanted(&job)             ? page_run(&job, &progress, &error)
                                                  : job_run(&job, &progress, &error);
        progress_end(&progress);
        finish_picture(r, &job, 0, ok, &error);
    }
    job_free(&job);
    json_decref(r->found);
    free(r->files.hashes);
    free(r->files.texts);
}

void batch_draw(const struct batch_drawing *drawing, const struct batch_artist *artist, struct batch_result *result)
{
    *result = (struct batch_result){.record_count = drawing->view_count,
                                    .records = calloc((size_t)drawing->view_count, sizeof *result->records),
                                    .outcomes = calloc((size_t)drawing->view_count, sizeof *result->outcomes)};
    if (!result->records || !result->outcomes) {
        say_error("out of memory");
        result->code = exit_code_of(LAM_LIMIT)->code;
        result->record_count = 0;
        return;
    }
    // Markers of lights are objects of the scene and depend on the camera, so a model with markers is read again for
    // each picture.
    int together = drawing->options->shading.show_lights ? 1 : drawing->view_count;
    for (int i = 0; i < drawing->view_count; i += together) {
        struct batch_drawing part = *drawing;
        struct batch_result own = *result;
        part.views += i;
        part.outputs += i;
        part.contents = part.contents ? part.contents + i : NULL;
        part.attempts += i;
        part.view_count = together;
        own.records += i;
        own.outcomes += i;
        struct model_run run = {.drawing = &part, .artist = artist, .result = &own};
        draw(&run);
        own.records = result->records;
        own.outcomes = result->outcomes;
        *result = own;
    }
}

void batch_result_free(struct batch_result *result)
{
    for (int i = 0; result->records && i < result->record_count; i++)
        json_decref(result->records[i]);
    free(result->records);
    free(result->outcomes);
    *result = (struct batch_result){0};
}
