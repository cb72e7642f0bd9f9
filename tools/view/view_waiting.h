// view_waiting.h: connections whose next request has not arrived completely. Anybody on this machine can open many of them and send nothing;
// the oldest are closed, so that the others are answered.
#ifndef VIEW_WAITING_H
#define VIEW_WAITING_H

#include "view.h"

enum { VIEW_WAITING_MAX = 128 };

// Of MHD_OPTION_NOTIFY_CONNECTION; `user` is the struct view, `kept` becomes a struct view_socket.
void view_waiting_notify(void *user, struct MHD_Connection *connection, void **kept,
                         enum MHD_ConnectionNotificationCode code);

// Of MHD_OPTION_URI_LOG_CALLBACK: notes the address as it was sent, in which the library has not yet decoded "%00". Returns NULL.
void *view_waiting_address(void *user, const char *address, struct MHD_Connection *connection);

// A connection's request has arrived. Returns the data of the connection, or NULL if there was no memory for it.
const struct view_socket *view_waiting_end(struct view *view, struct MHD_Connection *connection);

// A connection has been answered and may send another request.
void view_waiting_begin(struct view *view, struct MHD_Connection *connection);

// Closes connections that have waited for some seconds, and the oldest of more than VIEW_WAITING_MAX.
void view_waiting_drop(struct view *view);

#endif
