// view_answer.c: sends HTTP answers.
#include "view_answer.h"
#include "progress.h"
#include "view_page.h"

#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

void view_answer_headers(const struct view *view, struct MHD_Response *response, const char *type)
{
    static const char *const headers[][2] = {
        {"Cache-Control", "no-store"},
        {"X-Content-Type-Options", "nosniff"},
        {"Referrer-Policy", "no-referrer"}, // the address contains the token
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Cross-Origin-Opener-Policy", "same-origin"},
        {"Cross-Origin-Embedder-Policy", "require-corp"}, // both policies together enable threads in the page
        {"X-Frame-Options", "DENY"},
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
        view->http.MHD_add_response_header(response, headers[i][0], headers[i][1]);
    view->http.MHD_add_response_header(response, "Content-Type", type);
    // The page contains its own policy; other contents have a strict policy.
    view->http.MHD_add_response_header(response, "Content-Security-Policy",
                                       strncmp(type, "text/html", 9) == 0 ? "frame-ancestors 'none'"
                                                                          : "default-src 'none'; sandbox");
}

static enum MHD_Result queue(const struct view *view, struct MHD_Connection *connection, int status, const char *type,
                             struct MHD_Response *response)
{
    if (!response)
        return MHD_NO; // closes the connection
    view_answer_headers(view, response, type);
    if (status == MHD_HTTP_METHOD_NOT_ALLOWED)
        view->http.MHD_add_response_header(response, "Allow", "GET, HEAD");
    enum MHD_Result done = view->http.MHD_queue_response(connection, (unsigned)status, response);
    view->http.MHD_destroy_response(response);
    return done;
}

enum MHD_Result view_answer(const struct view *view, struct MHD_Connection *connection, int status, const char *type,
                            const void *bytes, size_t size, enum view_bytes whose)
{
    // The library's parameter is not const, but the library does not write to it.
    struct MHD_Response *response = view->http.MHD_create_response_from_buffer(
        size, (void *)(uintptr_t)bytes, whose == VIEW_OWNED ? MHD_RESPMEM_MUST_FREE : MHD_RESPMEM_PERSISTENT);
    if (!response && whose == VIEW_OWNED)
        free((void *)(uintptr_t)bytes);
    return queue(view, connection, status, type ? type : "text/plain; charset=utf-8", response);
}

enum MHD_Result view_answer_text(const struct view *view, struct MHD_Connection *connection, int status,
                                 const char *sentence)
{
    char *copy = strdup(sentence);
    return copy ? view_answer(view, connection, status, NULL, copy, strlen(copy), VIEW_OWNED) : MHD_NO;
}

enum MHD_Result view_answer_file(const struct view *view, struct MHD_Connection *connection, int file)
{
    struct stat about;
    if (fstat(file, &about) != 0) {
        close(file);
        return MHD_NO;
    }
    struct MHD_Response *response = view->http.MHD_create_response_from_fd64((uint64_t)about.st_size, file);
    if (!response)
        close(file);
    return queue(view, connection, MHD_HTTP_OK, "application/octet-stream", response);
}

enum MHD_Result view_answer_result(struct view_connection *c)
{
    static const char *const types[VIEW_KINDS] = {"application/json", "application/octet-stream", "image/png",
                                                  "application/json"};
    struct view_result result = c->result;
    c->result = (struct view_result){0};
    if (!result.bytes)
        return view_answer_text(c->view, c->connection, 503, "out of memory");
    size_t size = result.notes + result.data;
    memmove(result.bytes, result.bytes + result.notes_at, size);
    if (c->thumbnail && result.status == 422) { // browsers show a picture even if the status is an error
        result.bytes[size] = 0;                 // process_receive reserved a byte for the zero
        char *picture = view_gallery_failed(c->view, result.bytes, &size);
        free(result.bytes);
        return picture ? view_answer(c->view, c->connection, 422, "image/svg+xml", picture, size, VIEW_OWNED) : MHD_NO;
    }
    return view_answer(c->view, c->connection, result.status, result.status == 200 ? types[c->kind] : NULL,
                       result.bytes, size, VIEW_OWNED);
}

// --- limits the number of connections whose next request has not arrived completely.

enum { WAITING_MS = 5000 };

static struct view_socket *socket_of(const struct view *view, struct MHD_Connection *connection)
{
    const union MHD_ConnectionInfo *info =
        view->http.MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info ? info->socket_context : NULL;
}

// --- the list, from the oldest to the newest

static void append(struct view_sockets *list, struct view_socket *s)
{
    s->list = list;
    s->since_ms = clock_ms();
    s->before = list->newest;
    s->after = NULL;
    *(s->before ? &s->before->after : &list->oldest) = s;
    list->newest = s;
    list->count++;
}

static void take_out(struct view_socket *s)
{
    struct view_sockets *list = s->list;
    if (!list)
        return;
    s->list = NULL;
    *(s->before ? &s->before->after : &list->oldest) = s->after;
    *(s->after ? &s->after->before : &list->newest) = s->before;
    list->count--;
}

// --- reports of the library

void view_waiting_notify(void *user, struct MHD_Connection *connection, void **kept,
                         enum MHD_ConnectionNotificationCode code)
{
    struct view *view = user;
    struct view_socket *s = *kept;
    if (code == MHD_CONNECTION_NOTIFY_STARTED) {
        const union MHD_ConnectionInfo *info =
            view->http.MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
        *kept = s = info ? calloc(1, sizeof *s) : NULL;
        if (s) {
            s->file = info->connect_fd;
            append(&view->waiting, s);
        }
    } else if (s) {
        take_out(s);
        free(s);
        *kept = NULL;
    }
}

void *view_waiting_address(void *user, const char *address, struct MHD_Connection *connection)
{
    // The library needs up to ARGUMENT bytes of the connection's memory for each argument. Without enough memory, it
    // closes the connection without an answer.
    enum { ARGUMENT = 96 };
    static const char answer[] = "HTTP/1.1 414 URI Too Long\r\nConnection: close\r\nContent-Length: 29\r\n"
                                 "Content-Type: text/plain\r\n\r\nthe address has too many words";
    struct view_socket *s = socket_of(user, connection);
    size_t arguments = 1;
    for (const char *at = strchr(address, '?'); at; at = strchr(at + 1, '&'))
        arguments++;
    if (s && strlen(address) + arguments * ARGUMENT > VIEW_HEADERS_MAX / 4 * 3) {
        send(s->file, answer, sizeof answer - 1, MSG_NOSIGNAL | MSG_DONTWAIT);
        shutdown(s->file, SHUT_WR);
    }
    if (s)
        s->names_zero = strstr(address, "%00");
    return NULL;
}

const struct view_socket *view_waiting_end(struct view *view, struct MHD_Connection *connection)
{
    struct view_socket *s = socket_of(view, connection);
    if (s)
        take_out(s);
    return s;
}

void view_waiting_begin(struct view *view, struct MHD_Connection *connection, bool answers)
{
    struct view_socket *s = socket_of(view, connection);
    if (!s)
        return;
    take_out(s);
    append(answers ? &view->answering : &view->waiting, s);
}

// Shuts down both directions of the connection, so that the library closes it. If only reading were shut down, the
// kernel would still accept bytes, and the library would wait for more. Without a linger time the kernel immediately
// forgets a closed connection. Otherwise an attacker could fill the kernel's table, which is read for each request
// (view_access.c).
static void drop(struct view_socket *s)
{
    setsockopt(s->file, SOL_SOCKET, SO_LINGER, &(struct linger){.l_onoff = 1}, sizeof(struct linger));
    shutdown(s->file, SHUT_RDWR);
    take_out(s);
}

void view_waiting_drop(struct view *view)
{
    const double now = clock_ms();
    const struct view_sockets *waiting = &view->waiting, *answering = &view->answering;
    while (waiting->oldest && (waiting->count > VIEW_WAITING_MAX || now - waiting->oldest->since_ms > WAITING_MS))
        drop(waiting->oldest);
    while (answering->count > VIEW_ANSWERING_MAX)
        drop(answering->oldest);
}
