// view_waiting.c: limits the number of connections whose next request has not arrived completely.
#include "view_waiting.h"

#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#include "progress.h"

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
    s->waits = true;
    s->since_ms = clock_ms();
    s->before = list->newest;
    s->after = NULL;
    *(s->before ? &s->before->after : &list->oldest) = s;
    list->newest = s;
    list->count++;
}

static void take_out(struct view_sockets *list, struct view_socket *s)
{
    if (!s->waits)
        return;
    s->waits = false;
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
        take_out(&view->waiting, s);
        free(s);
        *kept = NULL;
    }
}

void *view_waiting_address(void *user, const char *address, struct MHD_Connection *connection)
{
    struct view_socket *s = socket_of(user, connection);
    if (s)
        s->names_zero = strstr(address, "%00");
    return NULL;
}

const struct view_socket *view_waiting_end(struct view *view, struct MHD_Connection *connection)
{
    struct view_socket *s = socket_of(view, connection);
    if (s)
        take_out(&view->waiting, s);
    return s;
}

void view_waiting_begin(struct view *view, struct MHD_Connection *connection)
{
    struct view_socket *s = socket_of(view, connection);
    if (s && !s->waits)
        append(&view->waiting, s);
}

// Shuts down both directions of the connection, so that the library closes it. If only reading were shut down, the
// kernel would still accept bytes, and the library would wait for more. Without a linger time the kernel immediately
// forgets a closed connection. Otherwise an attacker could fill the kernel's table, which is read for each request
// (view_peer.c).
static void drop(struct view_sockets *list, struct view_socket *s)
{
    setsockopt(s->file, SOL_SOCKET, SO_LINGER, &(struct linger){.l_onoff = 1}, sizeof(struct linger));
    shutdown(s->file, SHUT_RDWR);
    take_out(list, s);
}

void view_waiting_drop(struct view *view)
{
    struct view_sockets *list = &view->waiting;
    const double now = clock_ms();
    while (list->oldest && (list->count > VIEW_WAITING_MAX || now - list->oldest->since_ms > WAITING_MS))
        drop(list, list->oldest);
}
