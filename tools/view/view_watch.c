// view_watch.c: which files have changed. Folders are watched and not files: an editor puts a new file in the old one's place.
#include "view_watch.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WATCHED_MAX = 1000 };

// A file that is written is a whole one once it is closed; a link to an unnamed file, as lambent writes, only appears.
static const uint32_t events = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE;

void view_watch_start(struct view_watch *watch)
{
    *watch = (struct view_watch){.file = inotify_init1(IN_NONBLOCK | IN_CLOEXEC)};
}

void view_watch_end(struct view_watch *watch)
{
    for (int i = 0; i < watch->count; i++) {
        free(watch->items[i].folder);
        free(watch->items[i].only);
    }
    free(watch->items);
    if (watch->file >= 0)
        close(watch->file);
    *watch = (struct view_watch){.file = -1};
}

// Takes over `folder` and `only`.
static void add(struct view_watch *watch, const char *place, char *folder, char *only)
{
    struct view_watched *grown = NULL;
    int number = folder && watch->count < WATCHED_MAX ? inotify_add_watch(watch->file, place, events) : -1;
    for (int i = 0; i < watch->count && number >= 0; i++) {
        const struct view_watched *w = &watch->items[i];
        bool same = w->number == number && (only ? w->only && strcmp(w->only, only) == 0 : !w->only);
        if (same && strcmp(w->folder, folder) == 0)
            number = -1;
    }
    if (number >= 0)
        grown = realloc(watch->items, (size_t)(watch->count + 1) * sizeof *grown);
    if (grown) {
        watch->items = grown;
        grown[watch->count++] = (struct view_watched){number, folder, only};
        return;
    }
    free(folder);
    free(only);
}

// The model may be a link: then the file that it leads to counts too.
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

void view_watch_add(struct view_watch *watch, const struct view_files *files, const char *path)
{
    const char *slash = strrchr(path, '/');
    if (watch->file < 0 || !slash)
        return;
    char *folder = strndup(path, (size_t)(slash - path)),
         *place = folder ? view_files_path(files, *folder ? folder : "/") : NULL;
    int exists = folder ? view_files_open_folder(files, *folder ? folder : "/") : -1;
    if (exists >= 0)
        close(exists);
    if (exists >= 0 && place)
        add(watch, place, folder, NULL);
    else
        free(folder);
    free(place);
    if (files->model && strcmp(path, files->model) == 0)
        add_target(watch, files);
}

static void report(const struct view_watch *watch, const struct view_files *files, const struct inotify_event *event,
                   void (*changed)(void *user, const char *path), void *user)
{
    for (int i = 0; i < watch->count; i++) {
        const struct view_watched *w = &watch->items[i];
        char path[PATH_MAX + NAME_MAX + 2];
        if (w->number != event->wd || !event->len || (w->only && strcmp(w->only, event->name) != 0))
            continue;
        if (w->only)
            snprintf(path, sizeof path, "%s", files->model);
        else
            snprintf(path, sizeof path, "%s/%s", w->folder, event->name);
        changed(user, path);
    }
}

void view_watch_read(struct view_watch *watch, const struct view_files *files,
                     void (*changed)(void *user, const char *path), void *user)
{
    _Alignas(struct inotify_event) char buffer[16 << 10];
    for (ssize_t got; watch->file >= 0 && (got = read(watch->file, buffer, sizeof buffer)) > 0;)
        for (char *at = buffer; at < buffer + got;) {
            const struct inotify_event *event = (const struct inotify_event *)(const void *)at;
            report(watch, files, event, changed, user);
            at += sizeof *event + event->len;
        }
}
