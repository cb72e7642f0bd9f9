// target_request.c: fuzz target for requests to `lambent view`. An input is a request as a browser sends it: its first
// line ("GET /0123…cdef/files/a.obj?w=%2Fa.obj&x=1 HTTP/1.1") and headers; "TOKEN" in the address is the viewer's token.
// The target takes the place of libmicrohttpd: it decodes the request and receives the answer. A drawing is not
// started, but its words are parsed as the drawing process does.
#include "own_folder.h"
#include "target.h"

#include "view_events.h"
#include "view_page.h"
#include "view_answer.h"
#include "view_words.h"

enum { PAIRS_MAX = 32, PORT = 8080 };

struct MHD_Response {
    size_t size;
    void *bytes;
    int file;
    bool owned, has_type;
};

// A decoded request, with its answer.
struct MHD_Connection {
    char *method, *url;
    char *keys[PAIRS_MAX], *values[PAIRS_MAX]; // of the address, then of the headers
    int arguments, count;
    struct view_socket socket;
    union MHD_ConnectionInfo info;
    bool suspended;
    unsigned status; // 0: no answer
};

// --- the functions of the library

static int put_values(struct MHD_Connection *c, enum MHD_ValueKind kind, MHD_KeyValueIterator visit, void *user)
{
    int from = kind == MHD_HEADER_KIND ? c->arguments : 0, to = kind == MHD_HEADER_KIND ? c->count : c->arguments;
    for (int i = from; i < to; i++)
        if (visit(user, kind, c->keys[i], c->values[i]) == MHD_NO)
            return i - from + 1;
    return to - from;
}

static const char *value_of(struct MHD_Connection *c, enum MHD_ValueKind kind, const char *key)
{
    for (int i = 0; kind == MHD_GET_ARGUMENT_KIND && i < c->arguments; i++)
        if (strcmp(c->keys[i], key) == 0)
            return c->values[i];
    return NULL;
}

static const union MHD_ConnectionInfo *info_of(struct MHD_Connection *c, enum MHD_ConnectionInfoType type, ...)
{
    if (type == MHD_CONNECTION_INFO_SOCKET_CONTEXT)
        c->info.socket_context = &c->socket;
    else
        return NULL;
    return &c->info;
}

static struct MHD_Response *response(struct MHD_Response values)
{
    struct MHD_Response *made = malloc(sizeof *made);
    if (!made)
        abort();
    *made = values;
    return made;
}

static struct MHD_Response *of_buffer(size_t size, void *bytes, enum MHD_ResponseMemoryMode mode)
{
    return response(
        (struct MHD_Response){.size = size, .bytes = bytes, .file = -1, .owned = mode == MHD_RESPMEM_MUST_FREE});
}

static struct MHD_Response *of_file(uint64_t size, int file)
{
    return response((struct MHD_Response){.size = size, .file = file});
}

// Only the events are sent by a callback: it is called until it waits.
static struct MHD_Response *of_callback(uint64_t size, size_t block, MHD_ContentReaderCallback read, void *user,
                                        MHD_ContentReaderFreeCallback release)
{
    (void)size, (void)block, (void)read, (void)user, (void)release;
    return response((struct MHD_Response){.file = -1});
}

static enum MHD_Result add_header(struct MHD_Response *r, const char *name, const char *text)
{
    if (strpbrk(text, "\r\n")) // a header that the request could end
        abort();
    r->has_type |= strcmp(name, "Content-Type") == 0;
    return MHD_YES;
}

static enum MHD_Result queue(struct MHD_Connection *c, unsigned status, struct MHD_Response *r)
{
    if (c->status || !r->has_type) // a second answer
        abort();
    c->status = status;
    uint32_t sum = 0;
    for (size_t i = 0; r->bytes && i < r->size; i++) // reads each byte, for the sanitizer
        sum += ((const uint8_t *)r->bytes)[i];
    (void)*(volatile uint32_t *)&sum;
    return MHD_YES;
}

static void destroy(struct MHD_Response *r)
{
    if (r->owned)
        free(r->bytes);
    if (r->file >= 0)
        close(r->file);
    free(r);
}

static void suspend(struct MHD_Connection *c) { c->suspended = true; }

static void resume(struct MHD_Connection *c) { c->suspended = false; }

// --- requests

static int digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
}

// Decodes "%2F" and, in arguments, "+", in place.
static void unescape(char *text, bool argument)
{
    char *to = text;
    for (; *text; text++) {
        int high = *text == '%' ? digit(text[1]) : -1, low = high >= 0 ? digit(text[2]) : -1;
        *to++ = low >= 0 ? (char)(16 * high + low) : argument && *text == '+' ? ' ' : *text;
        text += low >= 0 ? 2 : 0;
    }
    *to = 0;
}

static void add_pair(struct MHD_Connection *c, char *key, char *value)
{
    if (c->count == PAIRS_MAX)
        return;
    c->keys[c->count] = key;
    c->values[c->count++] = value;
}

static void read_request(struct MHD_Connection *c, char *text)
{
    char *rest = text, *line = strsep(&rest, "\n");
    c->method = strsep(&line, " ");
    c->url = line ? strsep(&line, " ") : text + strlen(text);
    c->socket.names_zero = strstr(c->url, "%00");
    char *query = c->url;
    strsep(&query, "?");
    unescape(c->url, false);
    for (char *pair; query && (pair = strsep(&query, "&"));) {
        char *value = pair;
        strsep(&value, "=");
        unescape(pair, true);
        if (value)
            unescape(value, true);
        add_pair(c, pair, value);
    }
    c->arguments = c->count;
    while (rest && (line = strsep(&rest, "\n"))) {
        char *key = strsep(&line, ":");
        line = line ? line + strspn(line, " ") : NULL;
        if (line)
            line[strcspn(line, "\r")] = 0;
        add_pair(c, key, line);
    }
}

// The words of a task, as the drawing process parses them.
static void parse_words(const struct view *view, const struct view_task *task)
{
    struct view_words words;
    struct options options;
    lam_error error = {0};
    bool ok = view_words_parse(&words, task->words, (size_t)task->request.size, &view->files, view->options, &options,
                               &error);
    note_sentence(ok ? "" : error.text);
    if (ok ? error.code != LAM_OK || !words.model : error.code == LAM_OK || !error.text[0])
        abort();
    // Only shapes and files of the viewer's folder can be drawn.
    if (ok && lam_shape_find(words.model) < 0 && strncmp(words.model, own_folder, strlen(own_folder)) != 0 &&
        strchr(words.model, '/'))
        abort();
    options_free(&options);
    view_words_free(&words);
}

static struct view *viewer(void)
{
    static struct view view;
    static struct options options;
    static char words[] = "--background=white";
    char path[OWN_PATH];
    if (view.options)
        return &view;
    option_table_fill();
    options = option_defaults();
    own_path(path, "a.obj");
    write_own(path, "v 0 0 0\n", 8);
    own_path(path, "secret.txt");
    write_own(path, "secret", 6);
    view = (struct view){.options = &options,
                         .http = {.MHD_get_connection_values = put_values,
                                  .MHD_lookup_connection_value = value_of,
                                  .MHD_get_connection_info = info_of,
                                  .MHD_create_response_from_buffer = of_buffer,
                                  .MHD_create_response_from_fd64 = of_file,
                                  .MHD_create_response_from_callback = of_callback,
                                  .MHD_add_response_header = add_header,
                                  .MHD_queue_response = queue,
                                  .MHD_destroy_response = destroy,
                                  .MHD_suspend_connection = suspend,
                                  .MHD_resume_connection = resume},
                         .port = PORT,
                         .token = "0123456789abcdef0123456789abcdef",
                         .folder = own_folder,
                         .watch.file = -1,
                         .peers.tables = {-1, -1},
                         .page = {.text = (char *)(uintptr_t)"page",
                                  .size = 4,
                                  .words = words,
                                  .words_size = sizeof words,
                                  .fragment = (char *)(uintptr_t)"&--background%3Dwhite"}};
    if (!view_files_start(&view.files, own_folder, true, NULL))
        abort();
    view_tasks_start(&view.tasks, &view.files, &options, view_routes_done);
    return &view;
}

// Replaces "TOKEN" by the viewer's token.
static char *text_of(const uint8_t *data, size_t size, const char *token)
{
    const uint8_t *at = size ? memmem(data, size, "TOKEN", 5) : NULL;
    size_t before = at ? (size_t)(at - data) : size;
    char *text = NULL;
    if (asprintf(&text, "%.*s%s%.*s", (int)before, size ? (const char *)data : "", at ? token : "",
                 at ? (int)(size - before - 5) : 0, at ? (const char *)at + 5 : "") < 0)
        abort();
    return text;
}

// Invariant for every request: one answer, or a task that is then finished; nobody without the token gets more than a
// refusal.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct view *view = viewer();
    struct MHD_Connection connection = {0};
    char *text = text_of(data, size, view->token);
    const bool knows = strstr(text, view->token);
    read_request(&connection, text);
    void *kept = NULL;
    size_t none = 0;
    view->alive_ms = 1e300; // no comments between events
    enum MHD_Result done =
        view_routes_answer(view, &connection, connection.url, connection.method, "HTTP/1.1", NULL, &none, &kept);
    struct view_connection *c = kept;
    if (done == MHD_NO && connection.status)
        abort();
    if (c && c->task) {
        parse_words(view, c->task);
        if (size % 2)
            view_routes_lost(c); // answers 409
        else {
            struct view_result result = {.status = 422, .bytes = strdup("a sentence"), .notes = 10};
            view_tasks_drop(&view->tasks, c->task);
            view_routes_done(c, &result);
        }
        if (!c->finished || connection.suspended)
            abort();
        done = view_routes_answer(view, &connection, connection.url, connection.method, "HTTP/1.1", NULL, &none, &kept);
    }
    if (c && c->listener)
        view_events_changed(view, connection.url);
    if (done == MHD_YES && !connection.status)
        abort();
    if (!knows && connection.status != 403 && connection.status != 405)
        abort();
    note_sentence(connection.url);
    view_routes_completed(view, &connection, &kept, MHD_REQUEST_TERMINATED_COMPLETED_OK);
    if (view->tasks.first || view->connections || view->listeners)
        abort();
    view->waiting = (struct view_sockets){0};
    free(text);
    return 0;
}
