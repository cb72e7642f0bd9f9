// console.c: prints messages to standard error, and flushes standard output at the end.
#include "console.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/text.h>

#include "option_names.h"

static bool terminal, colors;
static _Thread_local FILE *captured; // NULL means standard error

void console_start(void)
{
    const char *term = getenv("TERM");
    const char *no_color = getenv("NO_COLOR"); // https://no-color.org: no colours if set and not empty
    terminal = isatty(STDERR_FILENO) && term && strcmp(term, "dumb") != 0;
    colors = terminal && !(no_color && *no_color);
}

bool console_is_terminal(void) { return terminal; }
bool console_has_colors(void) { return colors; }

void console_capture(FILE *stream) { captured = stream; }

static FILE *stream_of(void) { return captured ? captured : stderr; }

static void say(const char *color, const char *kind, const char *text)
{
    char named[MESSAGE_SIZE], shown[2 * MESSAGE_SIZE];
    lam_utf8_show(name_options(text, named), shown, sizeof shown);
    fprintf(stream_of(), "%slambent:%s%s %s\n", colors ? color : "", kind, colors ? "\033[0m" : "", shown);
}

void say_error(const char *text) { say("\033[1;31m", "", text); }
void say_warning(const char *text) { say("\033[1;33m", " warning:", text); }

void say_plain(const char *format, ...)
{
    char text[MESSAGE_SIZE], shown[2 * MESSAGE_SIZE];
    size_t end = strlen(format);
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(text, sizeof text, format, arguments) < 0)
        text[0] = 0;
    va_end(arguments);
    bool line = end && format[end - 1] == '\n';
    text[line && *text ? strlen(text) - 1 : strlen(text)] = 0;
    lam_utf8_show(text, shown, sizeof shown);
    fprintf(stream_of(), "%s%s", shown, line ? "\n" : "");
}

bool complain(lam_error *error, lam_code code, const char *format, ...)
{
    char text[2 * sizeof error->text];
    error->code = code;
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(text, sizeof text, format, arguments) < 0)
        text[0] = 0;
    va_end(arguments);
    lam_utf8_show(text, error->text, sizeof error->text);
    return false;
}

bool finish_output(lam_error *error)
{
    errno = 0;
    bool failed = fflush(stdout) != 0;
    if (failed || ferror(stdout))
        return complain(error, LAM_CANNOT_WRITE, "standard output: cannot write: %s",
                        errno ? strerror(errno) : "an earlier write failed");
    return true;
}
