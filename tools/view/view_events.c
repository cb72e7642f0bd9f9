// view_events.c: informs pages about changed files. A connection without new events is suspended, so that the library
// does not poll it.
#include "view_events.h"
#include "json.h"
#include "progress.h"
#include "view_answer.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    KEEP_MS = 10000,
    PENDING_MAX = 1 << 20, // limits the unsent bytes for a page that does not read its events
};

static void say(struct view_listener *l, const char *text, size_t size)
{
    char *more = l->size + size <= PENDING_MAX ? realloc(l->pending, l->size + size) : NULL;
    if (!more)
        return;
    memcpy(more + l->size, text, size);
    l->pending = more;
    l->size += size;
    if (l->suspended) {
        l->suspended = false;
        l->view->resumed = true;
        l->view->http.MHD_resume_connection(l->connection);
    }
}

static ssize_t read_pending(void *user, uint64_t at, char *to, size_t size)
{
    struct view_listener *l = user;
    (void)at;
    if (l->view->ends)
        return MHD_CONTENT_READER_END_OF_STREAM;
    if (!l->size) {
        l->suspended = true;
        l->view->http.MHD_suspend_connection(l->connection);
        return 0;
    }
    size_t taken = l->size < size ? l->size : size;
    memcpy(to, l->pending, taken);
    memmove(l->pending, l->pending + taken, l->size - taken);
    l->size -= taken;
    return (ssize_t)taken;
}

enum MHD_Result view_events_answer(struct view_connection *c)
{
    struct view *view = c->view;
    struct view_listener *l = calloc(1, sizeof *l);
    struct MHD_Response *response =
        l ? view->http.MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 4096, read_pending, l, NULL) : NULL;
    if (!response) {
        free(l);
        return MHD_NO;
    }
    *l = (struct view_listener){.connection = c->connection, .view = view, .next = view->listeners};
    view->listeners = c->listener = l;
    say(l, ": \n\n", 4);
    view_answer_headers(view, response, "text/event-stream");
    enum MHD_Result done = view->http.MHD_queue_response(c->connection, MHD_HTTP_OK, response);
    view->http.MHD_destroy_response(response);
    return done;
}

void view_events_changed(struct view *view, const char *path)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    fputs("data: ", out);
    struct json json = {.file = out};
    json_text(&json, NULL, path);
    fputs("\n\n", out);
    if (fclose(out) == 0)
        for (struct view_listener *l = view->listeners; l; l = l->next)
            say(l, text, size);
    free(text);
}

void view_events_wake(struct view_listener *listener)
{
    if (listener->suspended)
        say(listener, ": \n\n", 4);
}

void view_events_keep(struct view *view)
{
    double now = clock_ms();
    if (now - view->alive_ms < KEEP_MS)
        return;
    view->alive_ms = now;
    for (struct view_listener *l = view->listeners; l; l = l->next)
        view_events_wake(l);
}

void view_events_forget(struct view *view, struct view_listener *listener)
{
    for (struct view_listener **at = &view->listeners; *at; at = &(*at)->next)
        if (*at == listener) {
            *at = listener->next;
            break;
        }
    free(listener->pending);
    free(listener);
}

void view_events_end(struct view *view)
{
    view->ends = true;
    for (struct view_listener *l = view->listeners; l; l = l->next)
        if (l->suspended) {
            l->suspended = false;
            view->http.MHD_resume_connection(l->connection);
        }
}

// --- watches folders for changed files. Watching the files themselves would not work, because editors replace a file
// with a new file.

enum { WATCHED_MAX = 1000 };

// A file is complete once its writer closes it. If Lambent links an unnamed file to a name, the kernel reports only
// that the name was created.
static const uint32_t events =
    IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE | IN_DELETE_SELF | IN_MOVE_SELF;

void view_watch_start(struct view_watch *watch)
{
    *watch = (struct view_watch){.file = inotify_init1(IN_NONBLOCK | IN_CLOEXEC)};
}

void view_watch_end(struct view_watch *watch)
{
    for (int i = 0; i < watch->count; i++) {
        free(watch->items[i].real_path);
        free(watch->items[i].folder);
        free(watch->items[i].only);
    }
    free(watch->items);
    if (watch->file >= 0)
        close(watch->file);
    *watch = (struct view_watch){.file = -1};
}

// Takes ownership of `folder` and `only`.
static void add(struct view_watch *watch, const char *real_path, char *folder, char *only)
{
    struct view_watched *grown = NULL;
    char *own_path = strdup(real_path);
    int number =
        own_path && folder && watch->count < WATCHED_MAX ? inotify_add_watch(watch->file, real_path, events) : -1;
    for (int i = 0; i < watch->count && number >= 0; i++) {
        struct view_watched *w = &watch->items[i];
        bool same = strcmp(w->folder, folder) == 0 && (only ? w->only && strcmp(w->only, only) == 0 : !w->only);
        if (same && strcmp(w->real_path, real_path) == 0) {
            w->number = number; // another folder may now have this name
            number = -1;
        }
    }
    if (number >= 0)
        grown = realloc(watch->items, (size_t)(watch->count + 1) * sizeof *grown);
    if (grown) {
        watch->items = grown;
        grown[watch->count++] = (struct view_watched){number, own_path, folder, only};
        return;
    }
    free(own_path);
    free(folder);
    free(only);
}

// If the model is a link, also watches the link's target.
static void add_target(struct view_watch *watch, const struct view_files *files)
{
    struct stat about;
    if (lstat(files->model_path, &about) != 0 || !S_ISLNK(about.st_mode))
        return;
    char *real = realpath(files->model_path, NULL), *slash = real ? strrchr(real, '/') : NULL;
    if (slash) {
        char *only = strdup(slash + 1), *folder = strdup("");
        slash[slash == real] = 0;
        if (only)
            add(watch, real, folder, only);
        else
            free(folder);
    }
    free(real);
}

static bool is_there(const struct view_files *files, const char *folder)
{
    int file = view_files_open_folder(files, *folder ? folder : "/");
    if (file >= 0)
        close(file);
    return file >= 0;
}

void view_watch_add(struct view_watch *watch, const struct view_files *files, const char *path)
{
    const char *slash = strrchr(path, '/');
    if (watch->file < 0 || !slash)
        return;
    char *folder = strndup(path, (size_t)(slash - path)),
         *real_path = folder ? view_files_path(files, *folder ? folder : "/") : NULL;
    if (real_path && is_there(files, folder))
        add(watch, real_path, folder, NULL);
    else
        free(folder);
    free(real_path);
    if (files->model && strcmp(path, files->model) == 0)
        add_target(watch, files);
}

struct listener {
    void (*changed)(void *user, const char *path);
    void *user;
};

// Reports a changed file. An empty `name` means that any file of the folder may have changed.
static void report(const struct view_files *files, const struct view_watched *w, const char *name,
                   const struct listener *listener)
{
    char path[PATH_MAX + NAME_MAX + 2];
    if (*name && w->only && strcmp(w->only, name) != 0)
        return;
    if (w->only)
        snprintf(path, sizeof path, "%s", files->model);
    else
        snprintf(path, sizeof path, "%s/%s", w->folder, name);
    listener->changed(listener->user, path);
}

static void read_event(struct view_watch *watch, const struct view_files *files, const struct inotify_event *event,
                       const struct listener *listener)
{
    bool overflow = event->mask & IN_Q_OVERFLOW, gone = event->mask & (IN_IGNORED | IN_DELETE_SELF | IN_MOVE_SELF);
    for (int i = 0; i < watch->count; i++) {
        struct view_watched *w = &watch->items[i];
        if (!overflow && w->number != event->wd)
            continue;
        if (overflow || gone)
            w->number = -1;
        if (gone || (!overflow && event->len))
            report(files, w, gone ? "" : event->name, listener);
    }
}

// Watches a folder again after it was recreated.
static void find_again(struct view_watch *watch, const struct view_files *files, const struct listener *listener)
{
    for (int i = 0; i < watch->count; i++) {
        struct view_watched *w = &watch->items[i];
        if (w->number >= 0 || (!w->only && !is_there(files, w->folder)))
            continue;
        w->number = inotify_add_watch(watch->file, w->real_path, events);
        if (w->number >= 0)
            report(files, w, "", listener);
    }
}

void view_watch_read(struct view_watch *watch, const struct view_files *files,
                     void (*changed)(void *user, const char *path), void *user)
{
    _Alignas(struct inotify_event) char buffer[16 << 10];
    const struct listener listener = {changed, user};
    for (ssize_t got; watch->file >= 0 && (got = read(watch->file, buffer, sizeof buffer)) > 0;)
        for (char *at = buffer; at < buffer + got;) {
            const struct inotify_event *event = (const struct inotify_event *)(const void *)at;
            read_event(watch, files, event, &listener);
            at += sizeof *event + event->len;
        }
    find_again(watch, files, &listener);
}
