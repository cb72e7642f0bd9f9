// view_waiting.h: limits the number of connections whose next request has not arrived completely. Any user of this
// machine can open many connections and send nothing; the server closes the oldest connections, so that other requests
// are answered.
#ifndef VIEW_WAITING_H
#define VIEW_WAITING_H

#include "view.h"

enum { VIEW_WAITING_MAX = 128 };

// Callback for MHD_OPTION_NOTIFY_CONNECTION. `user` points to the struct view. Stores a struct view_socket in `kept`.
void view_waiting_notify(void *user, struct MHD_Connection *connection, void **kept,
                         enum MHD_ConnectionNotificationCode code);

// Callback for MHD_OPTION_URI_LOG_CALLBACK: checks the address for "%00" before the library decodes it. Returns NULL.
void *view_waiting_address(void *user, const char *address, struct MHD_Connection *connection);

// Must be called when a request has arrived. Returns the connection's data, or NULL if memory runs out.
const struct view_socket *view_waiting_end(struct view *view, struct MHD_Connection *connection);

// Must be called when a connection has been answered and may send another request.
void view_waiting_begin(struct view *view, struct MHD_Connection *connection);

// Closes connections that have waited for some seconds, and the oldest connections if there are more than
// VIEW_WAITING_MAX.
void view_waiting_drop(struct view *view);

#endif
