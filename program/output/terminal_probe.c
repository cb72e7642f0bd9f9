// terminal_probe.c: detects the graphics protocol of a terminal. Environment variables identify kitty, Ghostty, iTerm2
// and WezTerm. The program sends two queries to other terminals: the kitty graphics query, and "primary device
// attributes". Every terminal answers the second query, so the program stops waiting when this answer arrives.
//
// Kitty: https://sw.kovidgoyal.net/kitty/graphics-protocol/#querying-support-and-available-transmission-mediums
// Attributes (4 means sixel graphics) and the cell size (16 t): https://invisible-island.net/xterm/ctlseqs/ctlseqs.html
#include "terminal.h"

#include "file_io.h"
#include "progress.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

enum { WAIT_MS = 500, WAIT_MAX_MS = 60000 };

static bool env_is(const char *name, const char *value)
{
    const char *found = getenv(name);
    return found && strcmp(found, value) == 0;
}

static bool env_starts(const char *name, const char *start)
{
    const char *found = getenv(name);
    return found && strncmp(found, start, strlen(start)) == 0;
}

// tmux and screen pass on the environment of the outer terminal but not its graphics.
static bool is_multiplexed(void)
{
    return getenv("TMUX") || env_starts("TERM", "screen") || env_starts("TERM", "tmux");
}

// Identifies the terminal by its environment variables. Returns TERM_OFF for a terminal that cannot display pictures,
// and TERM_AUTO if a query is needed.
static enum term_kind kind_by_name(void)
{
    const char *term = getenv("TERM");
    if (!term || !*term || strcmp(term, "dumb") == 0 || strcmp(term, "linux") == 0 || getenv("INSIDE_EMACS") ||
        getenv("CI") || env_is("TERM_PROGRAM", "Apple_Terminal"))
        return TERM_OFF;
    if (is_multiplexed())
        return TERM_AUTO;
    if (strcmp(term, "xterm-kitty") == 0 || strcmp(term, "xterm-ghostty") == 0 || getenv("KITTY_WINDOW_ID") ||
        env_is("TERM_PROGRAM", "ghostty"))
        return TERM_KITTY;
    if (env_is("TERM_PROGRAM", "iTerm.app") || env_is("TERM_PROGRAM", "WezTerm"))
        return TERM_ITERM2;
    return TERM_AUTO;
}

// Returns the position of the numbers in the answer "ESC [ ? numbers c", or NULL if the answer has not arrived yet.
static const char *find_attributes(const char *text)
{
    for (const char *at = strstr(text, "\033[?"); at; at = strstr(at + 1, "\033[?"))
        if (at[3 + strspn(at + 3, "0123456789;")] == 'c')
            return at + 3;
    return NULL;
}

// Returns LAMBENT_TERM_WAIT, the number of milliseconds to wait for a terminal on a slow connection.
static int wait_ms(void)
{
    const char *text = getenv("LAMBENT_TERM_WAIT");
    char *end;
    long wanted = text && *text ? strtol(text, &end, 10) : WAIT_MS;
    return text && *text && (*end || wanted < 0) ? WAIT_MS : wanted > WAIT_MAX_MS ? WAIT_MAX_MS : (int)wanted;
}

// Reads until the last answer has arrived or the time has expired.
static void read_answers(int file, char *text, size_t size)
{
    double end = clock_ms() + wait_ms();
    size_t length = 0;
    text[0] = 0;
    while (length + 1 < size && !find_attributes(text)) {
        double left = end - clock_ms();
        struct pollfd wait = {.fd = file, .events = POLLIN};
        if (left <= 0 || (poll(&wait, 1, (int)left) < 0 && errno != EINTR))
            return;
        if (!(wait.revents & POLLIN)) {
            if (wait.revents)
                return; // the connection was closed
            continue;
        }
        ssize_t got = read(file, text + length, size - 1 - length);
        if (got < 0 && (errno == EINTR || errno == EAGAIN))
            continue;
        if (got <= 0)
            return;
        for (ssize_t i = 0; i < got; i++) // the text is a C string and must not contain zeros
            if (text[length + (size_t)i] == 0)
                text[length + (size_t)i] = '?';
        length += (size_t)got;
        text[length] = 0;
    }
}

// Sends a query with echo and line mode disabled. Blocks signals until the terminal's settings are restored.
static bool ask(int file, const char *question, char *answer, size_t size)
{
    struct termios before, raw;
    sigset_t held, old;
    if (tcgetattr(file, &before) != 0)
        return false;
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP};
    sigemptyset(&held);
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        sigaddset(&held, signals[i]);
    sigprocmask(SIG_BLOCK, &held, &old);
    raw = before;
    raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    bool ok = tcsetattr(file, TCSANOW, &raw) == 0 && write_all(file, question, strlen(question));
    if (ok)
        read_answers(file, answer, size);
    tcsetattr(file, TCSANOW, &before);
    sigprocmask(SIG_SETMASK, &old, NULL);
    return ok;
}

static void ask_terminal(int file, struct terminal *t, bool has_cells)
{
    char question[96], answer[512];
    snprintf(question, sizeof question, "%s%s\033[c",
             t->kind == TERM_AUTO ? "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\" : "", has_cells ? "" : "\033[16t");
    if (!ask(file, question, answer, sizeof answer))
        return;
    int width, height;
    const char *cell = strstr(answer, "\033[6;");
    if (!has_cells && cell && sscanf(cell, "\033[6;%4d;%4dt", &height, &width) == 2 && width > 0 && height > 0) {
        t->cell_width = width;
        t->cell_height = height;
    }
    if (t->kind != TERM_AUTO)
        return;
    if (strstr(answer, "\033_Gi=31;OK")) {
        t->kind = TERM_KITTY;
        return;
    }
    for (const char *at = find_attributes(answer); at && *at && *at != 'c'; at += *at == ';') {
        size_t digits = strspn(at, "0123456789");
        if (digits == 1 && *at == '4')
            t->kind = TERM_SIXEL;
        at += digits;
    }
}

struct terminal terminal_probe(bool asks)
{
    struct terminal t = {.kind = kind_by_name(), .columns = 80, .rows = 24, .cell_width = 10, .cell_height = 20};
    struct winsize size;
    bool has_cells = false;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0) {
        t.columns = size.ws_col;
        t.rows = size.ws_row;
        has_cells = size.ws_xpixel / size.ws_col > 0 && size.ws_ypixel / size.ws_row > 0;
        t.cell_width = has_cells ? size.ws_xpixel / size.ws_col : t.cell_width;
        t.cell_height = has_cells ? size.ws_ypixel / size.ws_row : t.cell_height;
    }
    const char *colors = getenv("COLORTERM"), *term = getenv("TERM");
    t.has_truecolor = colors && (strcmp(colors, "truecolor") == 0 || strcmp(colors, "24bit") == 0);
    t.has_256 = term && strstr(term, "256color");
    // Opens the terminal by its name, because standard output may be open only for writing.
    char name[256];
    int file = t.kind != TERM_OFF && asks && tcgetpgrp(STDOUT_FILENO) == getpgrp() &&
                       ttyname_r(STDOUT_FILENO, name, sizeof name) == 0
                   ? open(name, O_RDWR | O_NOCTTY | O_CLOEXEC)
                   : -1;
    if (file >= 0 && (t.kind == TERM_AUTO || !has_cells))
        ask_terminal(file, &t, has_cells);
    if (file >= 0)
        close(file);
    t.kind = t.kind == TERM_AUTO || tcgetpgrp(STDOUT_FILENO) != getpgrp() ? TERM_OFF : t.kind;
    return t;
}
