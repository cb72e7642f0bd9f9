// view_routes.h: answers HTTP requests.
//
// Every address starts with the token, "/0123…cdef/". The routes are "" (the page, or the gallery of a folder), "page",
// "gallery.css", "files/PATH", "thumb/PATH" and "events". The routes "model", "draw", "picture" and "explain" (x=, y=)
// read the words of the page's command line (w=…, repeated; c=… identifies the page).
#ifndef VIEW_ROUTES_H
#define VIEW_ROUTES_H

#include "view.h"

// Callbacks of MHD_start_daemon. `user` is the struct view.
enum MHD_Result view_routes_answer(void *user, struct MHD_Connection *connection, const char *url, const char *method,
                                   const char *version, const char *upload, size_t *upload_size, void **kept);
void view_routes_completed(void *user, struct MHD_Connection *connection, void **kept,
                           enum MHD_RequestTerminationCode code);

// Handles a waiting connection that the client has closed.
void view_routes_lost(struct view_connection *connection);

// Handles a finished task of a connection; see struct view_tasks.
void view_routes_done(void *user, struct view_result *result);

#endif
