// view_draw.c: implements the drawing process, which draws pictures on request.
#include "view_draw.h"

#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"
#include "limit_options.h"
#include "environment_cache.h"
#include "explain_json.h"
#include "file_io.h"
#include "job.h"
#include "kept_model.h"
#include "option_names.h"
#include "page.h"
#include "report.h"
#include "view_words.h"

static lam_cancel cancel; // cancels the current request; it is global because a signal handler uses it

static void cancel_request(int number)
{
    (void)number;
    lam_cancel_raise(&cancel);
}

struct drawer {
    const struct view_files *files;
    struct options limits;
    lam_device *device;
    int threads; // the number of threads of the device
    struct kept_model model;
    struct environment_cache *environments;
    uint64_t stamp; // the stamp of the kept model's files
    int to;
};

// --- answers

static void send_all(int to, const void *bytes, size_t size)
{
    if (!write_all(to, bytes, size))
        _exit(1);
}

static void answer(const struct drawer *d, int status, bool keeps, const char *notes, size_t size, const void *data,
                   size_t bytes)
{
    struct view_reply reply;
    memset(&reply, 0, sizeof reply); // including the padding, which is also sent
    reply.status = status;
    reply.keeps = keeps;
    reply.notes = (uint32_t)size;
    reply.data = bytes;
    send_all(d->to, &reply, sizeof reply);
    send_all(d->to, notes, size);
    send_all(d->to, data, bytes);
}

static void answer_error(const struct drawer *d, const lam_error *error)
{
    char shown[MESSAGE_SIZE];
    const char *text = name_options(error->text, shown);
    answer(d, error->code == LAM_CANCELLED ? 409 : 422, true, text, strlen(text), NULL, 0);
}

// --- the model

static uint64_t mix(uint64_t hash, uint64_t number) { return (hash ^ number) * 0x100000001b3u; } // one step of FNV-1a

// Returns a value that changes if the inode, size or modification time of one of the model's files changes.
static uint64_t stamp_of(const lam_scene *scene)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; lam_scene_file(scene, i); i++) {
        struct stat about = {0};
        bool there = stat(lam_scene_file(scene, i), &about) == 0;
        hash = mix(mix(mix(hash, there), (uint64_t)about.st_ino), (uint64_t)about.st_size);
        hash = mix(mix(hash, (uint64_t)about.st_mtim.tv_sec), (uint64_t)about.st_mtim.tv_nsec);
    }
    return hash;
}

static void forget(struct drawer *d)
{
    kept_model_forget(&d->model);
    environment_cache_free(d->environments);
    d->environments = NULL;
}

static bool take_model(struct drawer *d, struct job *job, lam_error *error)
{
    if (d->model.scene && stamp_of(d->model.scene) != d->stamp)
        forget(d);
    if (!d->environments)
        d->environments = environment_cache_make();
    if (d->device && d->threads != job->options->work.threads) {
        lam_device_free(d->device);
        d->device = NULL;
    }
    if (!d->device)
        d->device = device_option_make(job->options, error);
    d->threads = job->options->work.threads;
    job->device = d->device;
    job->environments = d->environments;
    bool ok = d->device && kept_model_take(&d->model, job, NULL, error);
    d->stamp = ok ? stamp_of(d->model.scene) : 0;
    return ok;
}

// --- VIEW_MODEL

// Writes the path under which the page requests a file. `inside` is the path relative to the model's folder.
static void put_path(struct json *json, const char *key, const char *page_model, const char *inside)
{
    char *path = NULL;
    int folder = (int)(strrchr(page_model, '/') - page_model);
    if (asprintf(&path, "%.*s%s", folder, page_model, inside) < 0)
        path = NULL;
    json_text(json, key, path);
    free(path);
}

// Writes the list of the model's missing files. The picture changes when one of these files is created.
static void put_missing(struct json *json, const struct job *job, const char *page_model)
{
    const char *slash = strrchr(job->model, '/'), *path;
    size_t length = slash ? (size_t)(slash + 1 - job->model) : 0;
    json_open(json, "missing", '[');
    for (int i = 0; (path = lam_scene_file(job->scene, i)); i++) {
        char *inside = NULL;
        if (strncmp(path, job->model, length) != 0 || access(path, F_OK) == 0)
            continue;
        if (asprintf(&inside, "/%s", path + length) < 0)
            inside = NULL;
        if (inside)
            put_path(json, NULL, page_model, inside);
        free(inside);
    }
    json_close(json, ']');
}

static uint64_t put_files(struct json *json, const struct page_model *model, const char *page_model)
{
    uint64_t bytes = 0;
    json_open(json, "files", '[');
    for (int i = 0; i < model->count; i++) {
        struct stat about;
        if (stat(model->files[i].path, &about) != 0)
            continue;
        bytes += (uint64_t)about.st_size;
        json_open(json, NULL, '{');
        put_path(json, "path", page_model, model->files[i].inside);
        json_put(json, COUNT("size", about.st_size));
        json_close(json, '}');
    }
    json_close(json, ']');
    return bytes;
}

// Returns NULL if the page itself can draw the model. Otherwise, writes the reason to `text` and returns `text`.
enum { REASON_SIZE = 700 };
static const char *reason_of(const struct job *job, const struct page_model *model, bool listed, const char *why,
                             uint64_t bytes, char text[REASON_SIZE])
{
    const lam_file_info *info = lam_scene_file_info(job->scene);
    const char *lacks = listed ? page_model_lacks(model, info, 0) : why;
    const struct model_counts *c = &job->model_counts;
    uint64_t parts = c->triangles + c->lines + c->points;
    if (lacks)
        snprintf(text, REASON_SIZE, "%s", lacks);
    else if (bytes > PAGE_FILES_MAX)
        snprintf(text, REASON_SIZE, "the model's files have %.1f MB, more than the %d MB that a page supports",
                 (double)bytes / 1e6, PAGE_FILES_MAX / 1000000);
    else if (parts > VIEW_TRIANGLES_MAX)
        snprintf(text, REASON_SIZE,
                 "the model has %" PRIu64 " triangles, lines and points, more than the %d that a page draws", parts,
                 VIEW_TRIANGLES_MAX);
    else
        return NULL;
    return text;
}

static void tell_model(struct drawer *d, struct job *job, const struct view_words *w)
{
    struct page_model model = {0};
    lam_error error = {0};
    char *text = NULL, reason[REASON_SIZE];
    size_t size = 0;
    bool listed = !job_model_is_shape(w->page_model) && page_model_list(job, &model, &error);
    FILE *out = open_memstream(&text, &size);
    if (!out)
        _exit(1);
    struct json json = {.file = out};
    json_open(&json, NULL, '{');
    uint64_t bytes = put_files(&json, &model, w->page_model);
    put_missing(&json, job, w->page_model);
    json_put(&json, COUNT("triangles", job->model_counts.triangles));
    const char *why = reason_of(job, &model, listed, error.text, bytes, reason);
    json_text(&json, "native", why);
    json_close(&json, '}');
    if (fclose(out) != 0)
        _exit(1);
    answer(d, 200, why != NULL, text, size, NULL, 0);
    page_model_free(&model);
    free(text);
}

// --- pictures

static void tell_pixels(struct drawer *d, struct job *job)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        _exit(1);
    struct json json = {.file = out};
    json_open(&json, NULL, '{');
    picture_json(&json, job, d->model.read_ms);
    json_close(&json, '}');
    putc('\n', out);
    if (fclose(out) != 0)
        _exit(1);
    answer(d, 200, true, text, size, job->image.pixels, (size_t)job->image.width * (size_t)job->image.height * 4);
    free(text);
}

static bool tell_explanation(struct drawer *d, struct job *job, const struct view_request *request, lam_error *error)
{
    const struct options *o = job->options;
    if (request->x < 0 || request->y < 0 || request->x >= o->picture.width || request->y >= o->picture.height)
        return complain(error, LAM_BAD_ARGUMENT, "pixel %d,%d is outside the picture", request->x, request->y);
    lam_explanation *explanation = job_explain(job, request->x, request->y, NULL, error);
    char *text = NULL;
    size_t size = 0;
    FILE *out = explanation ? open_memstream(&text, &size) : NULL;
    if (!explanation)
        return false;
    if (!out)
        _exit(1);
    explain_json(out, explanation, job);
    if (fclose(out) != 0)
        _exit(1);
    lam_explanation_free(explanation);
    answer(d, 200, true, text, size, NULL, 0);
    free(text);
    return true;
}

static bool draw(struct drawer *d, struct job *job, const struct view_words *w, const struct view_request *request,
                 lam_error *error)
{
    if (!take_model(d, job, error))
        return false;
    if (request->kind == VIEW_EXPLAIN)
        return tell_explanation(d, job, request, error);
    if (request->kind == VIEW_MODEL) {
        bool ok = job_load(job, NULL, error);
        if (ok)
            tell_model(d, job, w);
        return ok;
    }
    if (request->kind == VIEW_PIXELS) {
        bool ok = job_draw(job, LAM_RGBA8, NULL, error);
        if (ok)
            tell_pixels(d, job);
        return ok;
    }
    lam_bytes bytes = {0};
    job->output = "picture.png";
    job->picture_bytes = &bytes;
    bool ok = job_run(job, NULL, error);
    job->picture_bytes = NULL;
    if (ok)
        answer(d, 200, true, NULL, 0, bytes.data, bytes.size);
    lam_bytes_free(&bytes);
    return ok;
}

static void work(struct drawer *d, const struct view_request *request, const char *text)
{
    struct view_words w;
    struct options options;
    lam_error error = {0};
    d->limits.work.threads = request->threads;
    d->limits.limits.in_flight = request->in_flight;
    bool ok = view_words_parse(&w, text, (size_t)request->size, d->files, &d->limits, &options, &error);
    struct job job = {.options = &options, .model = w.model, .keeps_scene = true, .cancel = &cancel};
    job.times.start = clock_ms();
    ok = ok && draw(d, &job, &w, request, &error);
    if (!ok)
        answer_error(d, &error);
    if (job.scene == d->model.scene)
        job.scene = NULL; // the scene is kept
    job_free(&job);
    options_free(&options);
    view_words_free(&w);
}

// --- requests

void view_draw_serve(const struct view_files *files, const struct options *options, int from, int to)
{
    struct drawer d = {.files = files, .limits = *options, .to = to};
    struct sigaction action = {.sa_handler = cancel_request, .sa_flags = SA_RESTART};
    struct view_request request;
    sigemptyset(&action.sa_mask);
    sigaction(SIGUSR1, &action, NULL);
    signal(SIGINT, SIG_IGN); // the server ends this process
    signal(SIGPIPE, SIG_DFL);
    while (read_all(from, &request, sizeof request)) {
        char *text = malloc((size_t)request.size + 1);
        if (!text || !read_all(from, text, (size_t)request.size))
            break;
        lam_cancel_clear(&cancel);
        work(&d, &request, text);
        free(text);
    }
    _exit(0);
}
