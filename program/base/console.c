// console.c: prints messages to standard error, and flushes standard output at the end.
#include "console.h"
#include "option_names.h"

#include <lambent/base.h>
#include <lambent/text.h>

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

// --- the program's exit codes.

const struct exit_code exit_codes[] = {
    {0, LAM_OK, "ok", "done"},
    {1, LAM_BAD_ARGUMENT, "usage", "the command line is wrong"},
    {2, LAM_CANNOT_READ, "cannot-read", "a model cannot be read or is not valid in its format"},
    {3, LAM_UNSUPPORTED, "unsupported", "a format, an instruction set or a feature is not supported"},
    {4, LAM_LIMIT, "limit",
     "a limit was exceeded, such as time, memory or the size of a picture; or the machine has no memory, file "
     "descriptors or processes left"},
    {5, LAM_CANNOT_WRITE, "cannot-write",
     "the output cannot be written, or would overwrite a file that lambent did not write"},
    {EXIT_DIFFERS, -1, NULL,
     "`diff`: the pictures differ by more than the tolerance; `hash --check`: pictures differ from the hashes in the "
     "file; `check`: the shader does not pass; `info --print`: the model cannot be printed"},
    {EXIT_SOME_FAILED, -1, NULL,
     "`batch`, `diff` of folders, `hash`: some pictures failed (0 with `--failures-ok`, unless the machine failed); "
     "the "
     "messages and the journal name these pictures; `journal`: some pictures failed or are missing"},
    {EXIT_CRASHED, -1, "crashed", "`--isolate`: the process that drew the model ended without a result"},
    {130, LAM_CANCELLED, "cancelled", "interrupted (Ctrl-C); no partial files remain"},
    {0, -1, NULL, NULL},
};

const struct exit_code *exit_code_of(lam_code code)
{
    const struct exit_code *row = exit_codes;
    lam_code shown = code == LAM_MACHINE ? LAM_LIMIT : code;
    while (row->meaning && row->of != (int)shown)
        row++;
    return row;
}

const char *exit_code_name(const char *name)
{
    const struct exit_code *row = exit_codes;
    while (row->meaning && !(row->name && strcmp(row->name, name) == 0))
        row++;
    return row->meaning ? row->name : "failed";
}

// --- finds the known word that is most similar to a mistyped word.

struct suggestion suggest_start(const char *typed)
{
    // At most a third of the letters may differ; in short words, one letter may differ. One letter is like no other.
    const int length = (int)strlen(typed), allowed = length / 3;
    return (struct suggestion){.typed = typed, .distance = length < 2 ? 1 : allowed < 1 ? 2 : allowed + 1};
}

void suggest_try(struct suggestion *suggestion, const char *word)
{
    int distance = lam_word_distance(suggestion->typed, word);
    // If an equally similar word is a prefix of the best word so far, the prefix is preferred.
    const char *best = suggestion->best;
    bool shorter = best && distance == suggestion->distance && strncmp(best, word, strlen(word)) == 0;
    if (distance < suggestion->distance || shorter) {
        suggestion->distance = distance;
        suggestion->best = word;
    }
}

void suggest_also(struct suggestion *suggestion, const char *word, const char *others)
{
    for (size_t length; others && *others; others += length + (others[length] == ' ')) {
        char other[64];
        length = strcspn(others, " ");
        snprintf(other, sizeof other, "%.*s", (int)strcspn(others, "= "), others);
        int distance = lam_word_distance(suggestion->typed, other);
        if (distance < suggestion->distance) {
            suggestion->distance = distance;
            suggestion->best = word;
        }
    }
}
