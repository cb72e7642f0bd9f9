// view.h: implements `lambent view`. The server sends the page that shows a model or the gallery of a folder, and is
// reachable only from this machine.
#ifndef VIEW_H
#define VIEW_H

#include "http.h"
#include "view_page.h"
#include "view_access.h"
#include "view_tasks.h"
#include "view_events.h"

enum {
    VIEW_TOKEN_SIZE = 33, // 128 bits in hexadecimal digits, and the terminating zero
    VIEW_ADDRESS_SIZE = 80,
};

// A connection to a page that waits for file changes (server-sent events).
struct view_listener {
    struct MHD_Connection *connection;
    struct view *view;
    char *pending; // the text to send, allocated with malloc
    size_t size;
    bool suspended;
    struct view_listener *next;
};

// A network connection. The library stores this struct as the context of the socket.
struct view_socket {
    int file;
    bool names_zero;           // the address of the last request contains "%00"
    double since_ms;           // the clock_ms() at which the connection started to wait
    struct view_sockets *list; // the list that contains it, or NULL
    struct view_socket *before, *after;
};

// Connections that wait for their client, in the order in which they started to wait.
struct view_sockets {
    struct view_socket *oldest, *newest;
    int count;
};

// An HTTP request, from its first line to the end of the answer.
struct view_connection {
    struct view *view;
    struct MHD_Connection *connection;
    struct view_task *task; // the task that the request waits for
    struct view_result result;
    bool finished; // the task is finished and `result` is set
    enum view_kind kind;
    bool thumbnail;
    struct view_listener *listener;
    const struct view_socket *socket;
    struct view_connection *next; // the next in view.connections
};

struct view {
    const struct options *options;
    struct http http;
    struct MHD_Daemon *daemon;
    int port;
    char token[VIEW_TOKEN_SIZE];
    struct view_peers peers;
    const char *folder; // NULL if a single model is shown
    struct view_files files;
    struct view_page page;
    struct view_tasks tasks;
    struct view_watch watch;
    struct view_listener *listeners;
    struct view_sockets waiting;         // the connections whose next request has not arrived completely
    struct view_sockets answering;       // those whose answer has not been read completely: files, pictures and events
    struct view_connection *connections; // the requests with incomplete answers
    double alive_ms;                     // the clock_ms() of the last message to the listeners
    bool resumed;                        // the next MHD_run continues a connection
    bool ends;
};

// Serves until Ctrl-C, or until no connection has been open for `--idle` minutes. Prints the address. Fails with
// LAM_UNSUPPORTED (libmicrohttpd or the page is missing), LAM_CANNOT_READ (the operand), LAM_LIMIT (the port is in use,
// or sockets are not available) or LAM_BAD_ARGUMENT.
bool view_run(const char *operand, const struct options *options, lam_error *error);

#endif
