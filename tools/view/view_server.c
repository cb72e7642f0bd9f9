// view_server.c: starts the server, runs its loop and ends it. The server needs only one thread, because it can wait
// for all events with one call of poll.
#include "console.h"
#include "http.h"
#include "interrupt.h"
#include "progress.h"
#include "sandbox_start.h"
#include "show_all.h"
#include "view.h"
#include "view_answer.h"
#include "view_events.h"

#include <arpa/inet.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

// --- loads libmicrohttpd.

// Finds the address of a function. Copies the address, because ISO C does not allow the conversion of a void * to a
// function pointer.
static bool find(void *library, const char *name, void *function)
{
    void *address = dlsym(library, name);
    memcpy(function, &address, sizeof address);
    return address != NULL;
}

// Loads the library, which stays loaded until the program ends. Fails with LAM_UNSUPPORTED.
static bool http_open(struct http *http, lam_error *error)
{
    void *library = dlopen(HTTP_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return complain(error, LAM_UNSUPPORTED,
                        "view needs " HTTP_LIBRARY
                        ", which is not installed; install the Debian package libmicrohttpd12 or libmicrohttpd12t64");
    bool all = true;
#define LOOK_UP(name) all = find(library, #name, &http->name) && all;
    HTTP_FUNCTIONS(LOOK_UP)
    return all || complain(error, LAM_UNSUPPORTED,
                           HTTP_LIBRARY " lacks functions of libmicrohttpd 0.9.71; install a newer version");
}

// --- opens an address in the user's browser with xdg-open, which requires a display.

extern char **environ;

// Starting a browser needs a display and xdg-open. Returns whether the browser was started. Call this function before
// the sandbox is entered.
static bool browser_open(const char *address)
{
    static const char program[] = "xdg-open";
    const char *x11 = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    pid_t process;
    if (!(x11 && *x11) && !(wayland && *wayland))
        return false;
    // The browser keeps running if this program is interrupted. The browser's messages are discarded.
    bool ok = posix_spawn_file_actions_init(&actions) == 0;
    ok = ok && posix_spawnattr_init(&attributes) == 0;
    if (!ok)
        return false;
    ok = posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID) == 0;
    for (int file = 0; file < 3; file++)
        ok = ok && posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0) == 0;
    char *const words[] = {(char *)(uintptr_t)program, (char *)(uintptr_t)address, NULL};
    ok = ok && posix_spawnp(&process, program, &actions, &attributes, words, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return ok;
}

enum {
    CONNECTIONS_MAX = 256,
    SILENCE_S = 30, // the timeout of an idle connection
    STEP_MS = 500,
    IDLE_MINUTES = 30,
};

// --- start

static bool make_token(char token[VIEW_TOKEN_SIZE], lam_error *error)
{
    unsigned char random[(VIEW_TOKEN_SIZE - 1) / 2];
    if (getrandom(random, sizeof random, 0) != (ssize_t)sizeof random)
        return complain(error, LAM_LIMIT, "the system gives no random numbers: %s", strerror(errno));
    for (size_t i = 0; i < sizeof random; i++)
        snprintf(token + 2 * i, 3, "%02x", random[i]);
    return true;
}

// Returns a listening socket that only this machine can reach, or −1 on failure.
static int listen_here(struct view *view, lam_error *error)
{
    struct sockaddr_in address = {.sin_family = AF_INET,
                                  .sin_port = htons((uint16_t)view->options->viewer.port),
                                  .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof address;
    int file = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), yes = 1;
    bool ok = file >= 0 && setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
              bind(file, (struct sockaddr *)&address, sizeof address) == 0 && listen(file, SOMAXCONN) == 0 &&
              getsockname(file, (struct sockaddr *)&address, &size) == 0;
    view->port = ntohs(address.sin_port);
    if (ok)
        return file;
    if (view->options->viewer.port)
        complain(error, LAM_LIMIT, "cannot listen on port %d of 127.0.0.1: %s", view->options->viewer.port,
                 strerror(errno));
    else
        complain(error, LAM_LIMIT, "cannot listen on 127.0.0.1: %s", strerror(errno));
    if (file >= 0)
        close(file);
    return -1;
}

static void say_nothing(void *user, const char *format, va_list values) { (void)user, (void)format, (void)values; }

static bool start_daemon(struct view *view, lam_error *error)
{
    int socket = listen_here(view, error);
    if (socket < 0)
        return false;
    view->daemon = view->http.MHD_start_daemon(
        MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG, 0, NULL, NULL, view_routes_answer, view,
        MHD_OPTION_EXTERNAL_LOGGER, say_nothing, NULL, MHD_OPTION_LISTEN_SOCKET, socket, MHD_OPTION_CONNECTION_LIMIT,
        (unsigned)CONNECTIONS_MAX, MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)SILENCE_S,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)VIEW_HEADERS_MAX, MHD_OPTION_NOTIFY_COMPLETED,
        view_routes_completed, view, MHD_OPTION_NOTIFY_CONNECTION, view_waiting_notify, view,
        MHD_OPTION_URI_LOG_CALLBACK, view_waiting_address, view, MHD_OPTION_END);
    if (view->daemon)
        return true;
    const int reason = errno;
    close(socket);
    return complain(error, LAM_LIMIT, HTTP_LIBRARY " cannot start a server: %s", strerror(reason));
}

static bool find_operand(struct view *view, const char *operand, lam_error *error)
{
    struct stat about;
    if (strcmp(operand, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "view shows a file or a folder; standard input has no name");
    if (lam_shape_find(operand) >= 0)
        return true;
    if (stat(operand, &about) != 0)
        return complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", operand, strerror(errno));
    bool folder = S_ISDIR(about.st_mode);
    if (!folder && !S_ISREG(about.st_mode))
        return complain(error, LAM_CANNOT_READ, "%s: cannot read: is neither a file nor a folder", operand);
    view->folder = folder ? operand : NULL;
    return view_files_start(&view->files, operand, folder, error);
}

static bool enter_sandbox(const struct view *view, lam_error *error)
{
    struct sandbox_paths paths = {.serves = true, .imports = true};
    struct options options = *view->options;
    if (view->files.prefix)
        sandbox_add(&paths, *view->files.prefix ? view->files.prefix : "/", SANDBOX_READ);
    if (view->files.model_path)
        sandbox_add(&paths, view->files.model_path, SANDBOX_READ); // the model may be a link
    return sandbox_start(&options, &paths, error);
}

// --- messages

static void say_address(const struct view *view, const char *address, bool opened)
{
    const char *connection = getenv("SSH_CONNECTION"), *user = getenv("USER");
    char host[256] = "HOST";
    printf("%s\n", address);
    fflush(stdout);
    if (view->options->report.quiet)
        return;
    // Parses "CLIENT PORT SERVER PORT".
    if (!connection || sscanf(connection, "%*s %*s %255s", host) != 1)
        gethostname(host, sizeof host - 1);
    if (!opened)
        say_plain("from another machine: ssh -L %d:127.0.0.1:%d %s@%s, and open this address there\n", view->port,
                  view->port, user ? user : "USER", host);
    say_plain("Ctrl-C ends it\n");
}

// --- loop

static void hear_change(void *user, const char *path) { view_events_changed(user, path); }

static double idle_limit_ms(const struct options *o)
{
    return (o->viewer.has_idle ? o->viewer.idle_minutes : IDLE_MINUTES) * 60e3;
}

static unsigned connections(const struct view *view)
{
    const union MHD_DaemonInfo *info =
        view->http.MHD_get_daemon_info(view->daemon, MHD_DAEMON_INFO_CURRENT_CONNECTIONS);
    return info ? info->num_connections : 0;
}

// Waits for the next event, at most STEP_MS.
static void wait_for_something(const struct view *view)
{
    struct pollfd wait[VIEW_PROCESSES_MAX + CONNECTIONS_MAX + 2];
    struct view_connection *waiting[CONNECTIONS_MAX];
    nfds_t count = 2;
    int connection_count = 0;
    MHD_UNSIGNED_LONG_LONG most = STEP_MS;
    const union MHD_DaemonInfo *info = view->http.MHD_get_daemon_info(view->daemon, MHD_DAEMON_INFO_EPOLL_FD);
    wait[0] = (struct pollfd){.fd = info ? info->epoll_fd : -1, .events = POLLIN};
    wait[1] = (struct pollfd){.fd = view->watch.file, .events = POLLIN};
    for (int i = 0; i < view->tasks.count; i++)
        if (view->tasks.processes[i].child.pid > 0)
            wait[count++] = (struct pollfd){.fd = view->tasks.processes[i].child.from, .events = POLLIN};
    const nfds_t first = count;
    for (struct view_connection *c = view->connections; c && connection_count < CONNECTIONS_MAX; c = c->next)
        if (c->task || (c->listener && c->listener->suspended)) { // the library does not poll the connection
            waiting[connection_count++] = c;
            wait[count++] = (struct pollfd){.fd = c->socket->file, .events = POLLRDHUP};
        }
    if (view->http.MHD_get_timeout(view->daemon, &most) != MHD_YES || most > STEP_MS)
        most = STEP_MS;
    if (poll(wait, count, (int)most) <= 0)
        return;
    for (int i = 0; i < connection_count; i++)
        if (wait[first + (nfds_t)i].revents)
            view_routes_lost(waiting[i]);
}

static void loop(struct view *view)
{
    double idle_since = clock_ms(), limit = idle_limit_ms(view->options);
    while (!interrupted()) {
        view->resumed = false;
        view->http.MHD_run(view->daemon);
        view_watch_read(&view->watch, &view->files, hear_change, view);
        view_tasks_step(&view->tasks);
        view_events_keep(view);
        view_waiting_drop(view);
        double now = clock_ms();
        if (connections(view)) {
            idle_since = now;
        } else if (now - idle_since > limit) {
            if (!view->options->report.quiet)
                say_plain("ended: no page was open for %.10g minutes (--idle)\n", limit / 60e3);
            return;
        }
        if (!view->resumed) // older versions of the library do not count resumed connections in their timeout
            wait_for_something(view);
    }
}

static void finish(struct view *view)
{
    if (view->daemon) {
        // The library does not end suspended connections.
        view_events_end(view);
        view_tasks_end(&view->tasks);
        view->http.MHD_run(view->daemon);
        view->http.MHD_stop_daemon(view->daemon);
    }
    view_watch_end(&view->watch);
    view_peers_close(&view->peers);
    view_page_free(&view->page);
    view_files_free(&view->files);
}

static bool check(const struct options *o, lam_error *error)
{
    return !show_is_all(o) || complain(error, LAM_BAD_ARGUMENT,
                                       "option '--show all' writes the layers of an .exr file, and the viewer cannot "
                                       "show such a file; expected a single term, such as '--show diffuse'");
}

bool view_run(const char *operand, const struct options *options, lam_error *error)
{
    struct view view = {.options = options, .watch.file = -1, .peers.tables = {-1, -1}};
    bool ok = check(options, error) && http_open(&view.http, error) && find_operand(&view, operand, error) &&
              view_page_make(&view.page, options,
                             view.folder        ? NULL
                             : view.files.model ? view.files.model
                                                : operand,
                             &view.files, error) &&
              make_token(view.token, error);
    if (ok) {
        view_tasks_start(&view.tasks, &view.files, options, view_routes_done);
        view_watch_start(&view.watch);
        view_peers_open(&view.peers);
        setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0}); // drawing processes leave no core files
        interrupt_start();
        signal(SIGPIPE, SIG_IGN); // raised by closed connections and ended drawing processes
        ok = start_daemon(&view, error);
    }
    if (ok) {
        char address[VIEW_ADDRESS_SIZE];
        snprintf(address, sizeof address, "http://127.0.0.1:%d/%s/", view.port, view.token);
        bool opened = !options->viewer.no_open && browser_open(address);
        ok = enter_sandbox(&view, error);
        if (ok) {
            say_address(&view, address, opened);
            loop(&view);
        }
    }
    finish(&view);
    return ok;
}
