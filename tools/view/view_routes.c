// view_routes.c: decides which requests are answered. A page of another site can send requests to this server, and the
// site's host name may even resolve to this machine. However, such a page does not know the token, sends other Host and
// Origin headers, and cannot read the answers (view_answer.c).
#include "view_answer.h"

#include <arpa/inet.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>

#include "view_events.h"
#include "view_page.h"

// --- who asks

// Compares two tokens in a time that does not depend on the position of the first difference.
static bool same_token(const char *given, const char *token)
{
    unsigned difference = 0;
    for (size_t i = 0; i + 1 < VIEW_TOKEN_SIZE; i++)
        difference |= (unsigned)(unsigned char)given[i] ^ (unsigned)(unsigned char)token[i];
    return difference == 0;
}

struct header {
    const char *name, *value; // `value` is NULL if the header is missing
    int count;
};

static enum MHD_Result match_header(void *user, enum MHD_ValueKind kind, const char *key, const char *value)
{
    struct header *h = user;
    (void)kind;
    if (strcasecmp(key, h->name) == 0) {
        h->value = value ? value : "";
        h->count++;
    }
    return MHD_YES;
}

static struct header header(const struct view_connection *c, const char *name)
{
    struct header h = {.name = name};
    c->view->http.MHD_get_connection_values(c->connection, MHD_HEADER_KIND, match_header, &h);
    return h;
}

// Accepts "127.0.0.1:PORT" and "localhost:PORT".
static bool is_own_host(const struct view *view, const char *host)
{
    static const char *const names[] = {"127.0.0.1", "localhost"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char own[40];
        snprintf(own, sizeof own, "%s:%d", names[i], view->port);
        if (strcasecmp(host, own) == 0 || (view->port == 80 && strcasecmp(host, names[i]) == 0))
            return true;
    }
    return false;
}

// Returns whether, according to the browser's headers, the request is for this server and comes from one of its pages.
// Refuses repeated headers, because a relay may have checked only one of them.
static bool is_from_here(const struct view_connection *c)
{
    const struct header host = header(c, "Host"), origin = header(c, "Origin"), site = header(c, "Sec-Fetch-Site");
    return host.count == 1 && is_own_host(c->view, host.value) &&
           (!origin.count || (origin.count == 1 && strncmp(origin.value, "http://", 7) == 0 &&
                              is_own_host(c->view, origin.value + 7))) &&
           (!site.count ||
            (site.count == 1 && (strcmp(site.value, "same-origin") == 0 || strcmp(site.value, "none") == 0)));
}

// --- tasks

struct word_list {
    FILE *out;
    int count;
};

static enum MHD_Result put_word(void *user, enum MHD_ValueKind kind, const char *key, const char *value)
{
    struct word_list *list = user;
    (void)kind;
    if (strcmp(key, "w") == 0 && value) {
        fwrite(value, 1, strlen(value) + 1, list->out);
        list->count++;
    }
    return MHD_YES;
}

static int number_of(const struct view_connection *c, const char *key)
{
    const char *text = c->view->http.MHD_lookup_connection_value(c->connection, MHD_GET_ARGUMENT_KIND, key);
    char *end = NULL;
    long number = text ? strtol(text, &end, 10) : -1;
    return text && *text && !*end && number >= 0 && number < 1 << 20 ? (int)number : -1;
}

// Starts a task. The viewer answers the request when the task is finished.
static enum MHD_Result begin(struct view_connection *c, enum view_kind kind, const char *words, size_t size,
                             const char *client)
{
    struct view *view = c->view;
    if (view->ends) // the loop ends without answering new requests
        return view_answer_text(view, c->connection, 503, "the viewer has ended");
    struct view_request request = {.kind = kind, .x = number_of(c, "x"), .y = number_of(c, "y"), .size = (int)size};
    request.threads = client ? view->options->work.threads : 1;
    request.in_flight = client ? 1 : view->tasks.count - 1;
    c->kind = kind;
    if (kind == VIEW_MODEL)
        view_watch_add(&view->watch, &view->files, words); // watches even an invalid file, because the user may correct
                                                           // it
    c->task = view_tasks_add(&view->tasks, &request, words, client, c);
    if (!c->task)
        return view_answer_text(view, c->connection, 503, "out of memory");
    view->http.MHD_suspend_connection(c->connection);
    return MHD_YES;
}

static enum MHD_Result begin_words(struct view_connection *c, enum view_kind kind)
{
    const struct http *http = &c->view->http;
    const char *client = http->MHD_lookup_connection_value(c->connection, MHD_GET_ARGUMENT_KIND, "c");
    char *words = NULL;
    size_t size = 0;
    struct word_list list = {.out = open_memstream(&words, &size)};
    if (!list.out)
        return MHD_NO;
    http->MHD_get_connection_values(c->connection, MHD_GET_ARGUMENT_KIND, put_word, &list);
    enum MHD_Result done = MHD_NO;
    if (fclose(list.out) == 0)
        done = list.count ? begin(c, kind, words, size, client ? client : "")
                          : view_answer_text(c->view, c->connection, 400, "no words: w= is missing");
    free(words);
    return done;
}

static enum MHD_Result begin_thumbnail(struct view_connection *c, const char *path)
{
    size_t size = 0;
    int file = view_files_open(&c->view->files, path);
    if (file < 0)
        return view_answer_text(c->view, c->connection, 404, "no such model");
    close(file);
    char *words = view_gallery_words(c->view, path, &size);
    c->thumbnail = true;
    enum MHD_Result done = words ? begin(c, VIEW_PICTURE, words, size, NULL) : MHD_NO;
    free(words);
    return done;
}

// Watches the folders of a model's files.
static void watch_model(struct view *view, const char *text, size_t size)
{
    json_t *about = json_loadb(text, size, 0, NULL), *item;
    size_t i;
    json_array_foreach(json_object_get(about, "files"), i, item)
    {
        const char *path = json_string_value(json_object_get(item, "path"));
        if (path)
            view_watch_add(&view->watch, &view->files, path);
    }
    json_array_foreach(json_object_get(about, "missing"), i, item) if (json_is_string(item))
        view_watch_add(&view->watch, &view->files, json_string_value(item));
    json_decref(about);
}

void view_routes_done(void *user, struct view_result *result)
{
    struct view_connection *c = user;
    c->task = NULL;
    c->result = *result;
    c->finished = true;
    if (c->kind == VIEW_MODEL && result->status == 200 && result->bytes)
        watch_model(c->view, result->bytes + result->notes_at, result->notes);
    c->view->resumed = true;
    c->view->http.MHD_resume_connection(c->connection);
}

void view_routes_lost(struct view_connection *c)
{
    if (c->task) {
        struct view_result nothing = {.status = 409};
        view_tasks_drop(&c->view->tasks, c->task);
        view_routes_done(c, &nothing);
    }
    if (c->listener)
        view_events_wake(c->listener);
}

// --- addresses

static enum MHD_Result answer_gallery(struct view_connection *c)
{
    char *text = NULL;
    size_t size = 0;
    lam_error error = {0};
    return view_gallery_make(c->view, &text, &size, &error)
               ? view_answer(c->view, c->connection, 200, "text/html; charset=utf-8", text, size, VIEW_OWNED)
               : view_answer_text(c->view, c->connection, 500, error.text);
}

static enum MHD_Result answer_page(struct view_connection *c)
{
    const struct view_page *page = &c->view->page;
    return view_answer(c->view, c->connection, 200, "text/html; charset=utf-8", page->text, page->size, VIEW_BORROWED);
}

// If an address begins with `route`, returns the rest: the path in the page. Otherwise returns NULL.
static const char *path_after(const char *address, const char *route)
{
    size_t length = strlen(route);
    return strncmp(address, route, length) == 0 && address[length] == '/' ? address + length : NULL;
}

static enum MHD_Result answer_address(struct view_connection *c, const char *address)
{
    static const struct {
        const char *route;
        enum view_kind kind;
    } tasks[] = {{"model", VIEW_MODEL}, {"draw", VIEW_PIXELS}, {"picture", VIEW_PICTURE}, {"explain", VIEW_EXPLAIN}};
    const struct view *view = c->view;
    const char *path;
    if (!*address)
        return view->folder ? answer_gallery(c) : answer_page(c);
    if (strcmp(address, "page") == 0)
        return answer_page(c);
    if (strcmp(address, "gallery.css") == 0)
        return view_answer(view, c->connection, 200, "text/css", view_gallery_style, strlen(view_gallery_style),
                           VIEW_BORROWED);
    if (strcmp(address, "gallery.js") == 0)
        return view_answer(view, c->connection, 200, "text/javascript", view_gallery_script,
                           strlen(view_gallery_script), VIEW_BORROWED);
    if (strcmp(address, "threads.wasm") == 0 && view->page.module)
        return view_answer(view, c->connection, 200, "application/wasm", view->page.module, view->page.module_size,
                           VIEW_BORROWED);
    if (strcmp(address, "events") == 0)
        return view_events_answer(c);
    if ((path = path_after(address, "files"))) {
        int file = view_files_open(&view->files, path);
        return file >= 0 ? view_answer_file(view, c->connection, file)
                         : view_answer_text(view, c->connection, 404, "no such file");
    }
    if ((path = path_after(address, "thumb")))
        return begin_thumbnail(c, path);
    for (size_t i = 0; i < sizeof tasks / sizeof *tasks; i++)
        if (strcmp(address, tasks[i].route) == 0)
            return begin_words(c, tasks[i].kind);
    return view_answer_text(view, c->connection, 404, "no such page");
}

// Returns whether the request is from the viewer's user. Another user can read the token in the arguments of xdg-open
// in /proc.
static bool is_own_user(const struct view_connection *c)
{
    struct sockaddr_in other = {0};
    const union MHD_ConnectionInfo *info =
        c->view->http.MHD_get_connection_info(c->connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
    if (info && info->client_addr && info->client_addr->sa_family == AF_INET)
        memcpy(&other, info->client_addr, sizeof other);
    return other.sin_family != AF_INET ||
           view_peers_are_own(&c->view->peers, ntohs(other.sin_port), c->view->port, c->socket->since_ms);
}

static enum MHD_Result answer_request(struct view_connection *c, const char *url, const char *method)
{
    const struct view *view = c->view;
    if (strcmp(method, "GET") != 0 && strcmp(method, "HEAD") != 0)
        return view_answer_text(view, c->connection, MHD_HTTP_METHOD_NOT_ALLOWED, "only GET and HEAD are answered");
    if (!is_from_here(c))
        return view_answer_text(view, c->connection, 403, "not from here");
    if (strlen(url) < VIEW_TOKEN_SIZE + 1 || url[VIEW_TOKEN_SIZE] != '/' || !same_token(url + 1, view->token))
        return view_answer_text(view, c->connection, 403, "open the address that lambent view has printed");
    if (!is_own_user(c)) // this check comes last, because it reads the machine's table of all connections
        return view_answer_text(view, c->connection, 403, "this viewer answers only the user who has started it");
    if (c->socket->names_zero)
        return view_answer_text(view, c->connection, 404, "no name contains a zero byte");
    return answer_address(c, url + VIEW_TOKEN_SIZE + 1);
}

enum MHD_Result view_routes_answer(void *user, struct MHD_Connection *connection, const char *url, const char *method,
                                   const char *version, const char *upload, size_t *upload_size, void **kept)
{
    struct view_connection *c = *kept;
    (void)version, (void)upload;
    if (c && c->finished) {
        c->finished = false;
        view_waiting_begin(user, connection, true);
        return view_answer_result(c);
    }
    if (c) { // a repeated call for the same request: the library passes the body, or a task is still running
        *upload_size = 0;
        return MHD_YES;
    }
    struct view *view = user;
    const struct view_socket *socket = view_waiting_end(view, connection);
    c = socket ? calloc(1, sizeof *c) : NULL;
    if (!c)
        return MHD_NO;
    *c = (struct view_connection){.view = view, .connection = connection, .socket = socket, .next = view->connections};
    view->connections = *kept = c;
    enum MHD_Result done = answer_request(c, url, method);
    if (!c->task)
        view_waiting_begin(view, connection, true);
    return done;
}

void view_routes_completed(void *user, struct MHD_Connection *connection, void **kept,
                           enum MHD_RequestTerminationCode code)
{
    struct view *view = user;
    struct view_connection *c = *kept;
    (void)code;
    *kept = NULL;
    view_waiting_begin(view, connection, false);
    if (!c)
        return;
    for (struct view_connection **at = &view->connections; *at; at = &(*at)->next)
        if (*at == c) {
            *at = c->next;
            break;
        }
    if (c->task)
        view_tasks_drop(&view->tasks, c->task);
    if (c->listener)
        view_events_forget(view, c->listener);
    free(c->result.bytes);
    free(c);
}
