// console.c: prints messages to standard error, and flushes standard output at the end.
#include "console.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

void say_error(const char *text)
{
    char shown[MESSAGE_SIZE];
    fprintf(stream_of(), "%slambent:%s %s\n", colors ? "\033[1;31m" : "", colors ? "\033[0m" : "",
            name_options(text, shown));
}

void say_warning(const char *text)
{
    char shown[MESSAGE_SIZE];
    fprintf(stream_of(), "%slambent: warning:%s %s\n", colors ? "\033[1;33m" : "", colors ? "\033[0m" : "",
            name_options(text, shown));
}

void say_plain(const char *format, ...)
{
    va_list arguments;
    char *text;
    va_start(arguments, format);
    int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0)
        return;
    for (char *c = text; *c; c++) // file names may contain escape sequences
        *c = ((unsigned char)*c < ' ' && *c != '\n' && *c != '\t') || *c == 0x7f ? '?' : *c;
    fputs(text, stream_of());
    free(text);
}

size_t text_hidden(const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    if (c[0] == 0xc2 && c[1] >= 0x80 && c[1] <= 0x9f) // U+0080 to U+009F
        return 2;
    bool order = c[0] == 0xe2 && ((c[1] == 0x80 && (c[2] == 0x8e || c[2] == 0x8f || (c[2] >= 0xaa && c[2] <= 0xae))) ||
                                  (c[1] == 0x81 && c[2] >= 0xa6 && c[2] <= 0xa9));
    return order ? 3 : (c[0] < ' ' && c[0] && c[0] != '\n' && c[0] != '\r' && c[0] != '\t') || c[0] == 0x7f;
}

void print_name(FILE *out, const char *name)
{
    for (; *name; name++) {
        size_t hidden = text_hidden(name);
        if (hidden || *name == '\t')
            putc('?', out);
        else if (*name == '\\' || *name == '\n' || *name == '\r')
            fprintf(out, "\\%c", *name == '\n' ? 'n' : *name == '\r' ? 'r' : '\\');
        else
            putc(*name, out);
        name += hidden ? hidden - 1 : 0;
    }
}

bool complain(lam_error *error, lam_code code, const char *format, ...)
{
    error->code = code;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    for (char *c = error->text; *c; c++) // file names may contain control codes
        if ((unsigned char)*c < 0x20 || *c == 0x7F)
            *c = '?';
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
