// view_routes.h: which requests are answered, and by what.
//
// Every address begins with the token, "/0123…cdef/". Below it: "" (the page, or the gallery of a folder), "page", "gallery.css",
// "files/PATH", "thumb/PATH", "events", and with the words of the page's command line (w=…, repeated; c=… names the page) "model", "draw",
// "picture" and "explain" (x=, y=).
#ifndef VIEW_ROUTES_H
#define VIEW_ROUTES_H

#include "view.h"

// Callbacks of MHD_start_daemon; `user` is the struct view.
enum MHD_Result view_routes_answer(void *user, struct MHD_Connection *connection, const char *url, const char *method,
                                   const char *version, const char *upload, size_t *upload_size, void **kept);
void view_routes_completed(void *user, struct MHD_Connection *connection, void **kept,
                           enum MHD_RequestTerminationCode code);

// The other end of a connection that waits has closed it.
void view_routes_lost(struct view_connection *connection);

// A task of a connection is done; see struct view_tasks.
void view_routes_done(void *user, struct view_result *result);

#endif
