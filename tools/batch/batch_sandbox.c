// batch_sandbox.c: sets up the sandbox of a batch.
#include "batch_sandbox.h"

#include <stdlib.h>
#include <string.h>

#include "animate_frame.h"
#include "batch_job.h"
#include "batch.h"
#include "console.h"
#include "limit_options.h"
#include "output.h"
#include "page.h"
#include "sandbox_start.h"

// The maximum number of older pictures that are made readable one by one. If there are more, their whole folder is made
// readable.
enum { SINGLE = 64 };

// Returns whether the whole folder of pictures must be readable, because the run reads older pictures for the journal
// and the page.
static bool takes_folder(const struct batch *b)
{
    return !b->options->batch.jobs && !b->use &&
           (b->options_text || b->plan->count * (size_t)b->plan->view_count > SINGLE);
}

// Returns the folder of a path, or "." if the path contains no folder. The result is allocated with malloc.
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
}

static bool make_folder(char *folder, lam_error *error)
{
    char *file = NULL;
    bool ok = folder && asprintf(&file, "%s%s", folder, *folder ? "." : "./.") >= 0;
    ok = ok ? output_make_folder(file, error) : complain(error, LAM_MACHINE, "out of memory");
    free(file);
    free(folder);
    return ok;
}

bool batch_sandbox_make_folders(const struct batch *b, const char *journal, lam_error *error)
{
    const char *page = b->options->batch.report_page;
    return (!takes_folder(b) || make_folder(batch_plan_folder(b->plan), error)) &&
           (!journal || make_folder(folder_of(journal), error)) && (!page || make_folder(folder_of(page), error));
}

static void add_folder(struct sandbox_paths *paths, char *folder, int access)
{
    if (folder)
        sandbox_add(paths, *folder ? folder : ".", access);
    paths->failed |= !folder;
    free(folder);
}

// Adds the page template to the readable files. If the template is missing, writing a picture reports the error.
static void add_page(struct sandbox_paths *paths)
{
    lam_error error;
    char *page = page_file_find(&error);
    if (page)
        sandbox_add(paths, page, SANDBOX_READ);
    free(page);
}

// --- writable files

struct writes {
    const struct batch *batch;
    const struct batch_plan *plan; // the plan of the batch, or of a job
    size_t first, count;           // the range of models to draw
    size_t latest;                 // index of the model of the most recently written picture
    int latest_view;               // its view
    bool whole;                    // true for the whole batch, false for a process that draws one model
};

static bool is_picture_of(struct writes *w, size_t model, const char *path)
{
    const int count = w->plan->view_count, first = w->latest_view;
    char *transforms = NULL;
    bool is = false;
    for (int k = 0; !is && k < count; k++) {
        char *output = batch_plan_output(w->plan, model, (first + k) % count);
        is = output && (strcmp(output, path) == 0 ||
                        (animation_wanted(w->plan->options) && animation_is_frame(w->plan->options, output, path)));
        w->latest_view = is ? (first + k) % count : first;
        free(output);
    }
    is = is || (batch_plan_transforms(w->plan, model, &transforms) && transforms && strcmp(transforms, path) == 0);
    free(transforms);
    return is;
}

// Models are drawn approximately in order, so the search begins at the latest model and proceeds in both directions.
static bool is_picture(struct writes *w, const char *path)
{
    for (size_t distance = 0; distance < w->count; distance++) {
        size_t up = w->latest + distance, down = w->latest - distance;
        bool above = up < w->first + w->count && is_picture_of(w, up, path);
        if (above || (distance && distance <= w->latest - w->first && is_picture_of(w, down, path))) {
            w->latest = above ? up : down;
            return true;
        }
    }
    return false;
}

// A run may write the pictures of its plan, its own page and its scene file. A worker with --jobs does not know the
// names in advance, so it may write any new picture or page below --allow-path.
static enum writer_right right_of(void *user, const char *path)
{
    struct writes *w = user;
    const struct batch *b = w->batch;
    const struct options *o = b->options;
    lam_error error;
    lam_pixel_format format;
    if (b->use)
        return b->use->right ? b->use->right(b->use->user, path) : WRITER_NONE;
    if (w->whole && b->journal && strcmp(path, journal_running_path(b->journal)) == 0)
        return WRITER_REMOVES;
    if ((w->whole && o->batch.report_page && strcmp(path, o->batch.report_page) == 0) ||
        (o->picture.save_scene && strcmp(path, o->picture.save_scene) == 0))
        return WRITER_ANY;
    if (o->batch.report_page && batch_page_is_thumbnail(o->batch.report_page, path))
        return WRITER_NEW_OR_OURS;
    if (b->jobs && w->whole) {
        bool named = lam_image_format_for(path, &format, NULL) || page_is_named(path);
        return named && job_roots_have(o, path, true, &error) ? WRITER_NEW_OR_OURS : WRITER_NONE;
    }
    return !is_picture(w, path)                                                ? WRITER_NONE
           : output_given(w->plan->options->picture.output) == OUTPUT_BY_MODEL ? WRITER_NEW_OR_OURS
                                                                               : WRITER_ANY;
}

// Adds the folders in which the writer writes.
static void add_written(const struct writes *w, struct sandbox_paths *paths)
{
    const struct batch *b = w->batch;
    const struct options *o = b->options;
    const char *const named[] = {o->batch.report_page, o->picture.save_scene,
                                 b->journal ? journal_running_path(b->journal) : NULL};
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (named[i])
            sandbox_add(paths, named[i], SANDBOX_MAKE);
    for (int i = 0; b->use && i < BATCH_RECEIVER_FILES; i++)
        if (b->use->files[i])
            sandbox_add(paths, b->use->files[i], SANDBOX_MAKE);
    for (int i = 0; b->jobs && w->whole && i < o->limits.allow_paths.count; i++)
        sandbox_add(paths, o->limits.allow_paths.items[i], SANDBOX_MAKE);
    if (!b->use && !(b->jobs && w->whole))
        add_folder(paths, batch_plan_folder(w->plan), SANDBOX_MAKE);
}

bool batch_sandbox_start_writer(const struct batch *b, const struct batch_task *task, lam_error *error)
{
    struct writes writes = {b, task->plan, task->model, 1, task->model, 0, false};
    bool writes_none = b->use ? !b->use->right : task->job && task->job->in_answer;
    if (writes_none || !sandbox_is_wanted(b->options))
        return true;
    struct sandbox_paths paths = {.may_write = right_of, .user = &writes, .writers = 1};
    add_written(&writes, &paths);
    bool ok = paths.failed ? complain(error, LAM_MACHINE, "out of memory")
                           : writer_start(&paths, limits_memory(b->options), error);
    sandbox_paths_free(&paths);
    return ok;
}

// --- the sandbox

bool batch_sandbox_enter(const struct batch *b, size_t first, size_t count, lam_error *error)
{
    struct writes writes = {b, b->plan, first, count, first, 0, true};
    struct sandbox_paths paths = {.may_write = right_of, .user = &writes, .writers = b->workers};
    const struct batch_model *models = b->plan->models;
    for (size_t i = first; i < first + count; i++) {
        sandbox_add_input(&paths, models[i].path);
        if (b->use && b->use->reach)
            b->use->reach(b->use->user, i, &paths);
        for (int k = 0; !b->use && !takes_folder(b) && k < b->plan->view_count; k++) {
            char *output = batch_plan_output(b->plan, i, k);
            paths.failed |= !output;
            if (output)
                sandbox_add_older(&paths, output);
            free(output);
        }
    }
    if (takes_folder(b))
        add_folder(&paths, batch_plan_folder(b->plan), SANDBOX_READ);
    if (b->options->batch.jobs || page_is_named(b->options->picture.output)) // a job may request a page
        add_page(&paths);
    add_written(&writes, &paths);
    return sandbox_start(b->options, &paths, error);
}

bool batch_sandbox_enter_job(const struct batch_job *job, lam_error *error)
{
    struct sandbox_paths paths = {0};
    if (!job->in_answer && !make_folder(batch_plan_folder(&job->plan), error))
        return false;
    if (!job->in_answer)
        add_folder(&paths, batch_plan_folder(&job->plan), SANDBOX_READ);
    if (!job->bytes.data)
        sandbox_add_input(&paths, job->plan.models[0].path);
    if (!job->in_answer)
        add_page(&paths);
    return sandbox_start(&job->options, &paths, error);
}
