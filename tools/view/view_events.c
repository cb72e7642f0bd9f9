// view_events.c: informs pages about changed files. A connection without new events is suspended, so that the library
// does not poll it.
#include "view_events.h"

#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "progress.h"
#include "view_answer.h"

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
