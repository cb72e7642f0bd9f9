// view_answer.h: sends HTTP answers, with headers that block access by other pages.
#ifndef VIEW_ANSWER_H
#define VIEW_ANSWER_H

#include "view.h"

enum view_bytes {
    VIEW_BORROWED, // the caller's bytes, valid until the server ends
    VIEW_OWNED,    // bytes allocated with malloc; the library frees them after the answer
};

// Queues an answer. If `type` is NULL, the answer is plain text.
enum MHD_Result view_answer(const struct view *view, struct MHD_Connection *connection, int status, const char *type,
                            const void *bytes, size_t size, enum view_bytes whose);

// Answers with a sentence.
enum MHD_Result view_answer_text(const struct view *view, struct MHD_Connection *connection, int status,
                                 const char *sentence);

// Answers with the contents of a file, and closes the handle `file` at the end.
enum MHD_Result view_answer_file(const struct view *view, struct MHD_Connection *connection, int file);

// Answers a connection with the result of its task.
enum MHD_Result view_answer_result(struct view_connection *connection);

// Adds the headers of all answers to the caller's response.
void view_answer_headers(const struct view *view, struct MHD_Response *response, const char *type);

// --- limits the number of connections whose next request has not arrived completely. Any user of this machine can open
// many connections and send nothing; the server closes the oldest connections, so that other requests are answered.

enum {
    VIEW_WAITING_MAX = 128,
    VIEW_ANSWERING_MAX = 64,
    VIEW_HEADERS_MAX = 64 << 10, // bytes of a request, and of the library's list of its arguments
};

// Callback for MHD_OPTION_NOTIFY_CONNECTION. `user` points to the struct view. Stores a struct view_socket in `kept`.
void view_waiting_notify(void *user, struct MHD_Connection *connection, void **kept,
                         enum MHD_ConnectionNotificationCode code);

// Callback for MHD_OPTION_URI_LOG_CALLBACK: checks the address for "%00" before the library decodes it. Answers a
// request with too many arguments. Returns NULL.
void *view_waiting_address(void *user, const char *address, struct MHD_Connection *connection);

// Must be called when a request has arrived. Returns the connection's data, or NULL if memory runs out.
const struct view_socket *view_waiting_end(struct view *view, struct MHD_Connection *connection);

// Must be called when the client must read an answer (`answers`), or may send another request.
void view_waiting_begin(struct view *view, struct MHD_Connection *connection, bool answers);

// Closes connections that have waited for a request for some seconds. Also closes the oldest connections if more than
// VIEW_WAITING_MAX wait for a request, or more than VIEW_ANSWERING_MAX have not read their answers. A page whose events
// end opens another connection for them.
void view_waiting_drop(struct view *view);

// --- answers HTTP requests.
//
// Every address starts with the token, "/0123…cdef/". The routes are "" (the page, or the gallery of a folder), "page",
// "gallery.css", "files/PATH", "thumb/PATH" and "events". The routes "model", "draw", "picture" and "explain" (x=, y=)
// read the words of the page's command line (w=…, repeated; c=… identifies the page).

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
