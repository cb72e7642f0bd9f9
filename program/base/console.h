// console.h: prints messages to standard error, and flushes standard output at the end.
#ifndef CONSOLE_H
#define CONSOLE_H

#include <lambent/base.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// Detects once whether standard error is a terminal with colours (NO_COLOR and TERM=dumb disable them).
void console_start(void);
bool console_is_terminal(void); // returns whether standard error is a terminal with a movable cursor
bool console_has_colors(void);

// Print one line on standard error: "lambent: …" and "lambent: warning: …".
void say_error(const char *text);
void say_warning(const char *text);
// Redirects the messages of this thread to `stream`, so that the caller can print them later, in order. NULL ends the
// redirection.
void console_capture(FILE *stream);
// Prints text as lam_utf8_show, except for a line ending at the end of `format`.
void say_plain(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Stores a code and a message in an error. The message is formatted like printf. Returns false.
bool complain(lam_error *error, lam_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

// Flushes standard output. Fails with LAM_CANNOT_WRITE if some output was lost.
bool finish_output(lam_error *error);

// --- the program's exit codes. main(), the reports, the help, the man page and the docs use the same table. The
// numbers are independent of lam_code.

enum { EXIT_DIFFERS = 6, EXIT_SOME_FAILED = 7, EXIT_CRASHED = 8 };

struct exit_code {
    int code;
    int of;              // the corresponding lam_code, or −1
    const char *name;    // the name in reports, or NULL
    const char *meaning; // NULL at the end of the table
};
extern const struct exit_code exit_codes[];

const struct exit_code *exit_code_of(lam_code code);

// Returns the table's string that equals `name`, or "failed" if the table does not contain this name.
const char *exit_code_name(const char *name);

// --- finds the known word that is most similar to a mistyped word.

struct suggestion {
    const char *typed;
    const char *best; // NULL if no word is similar enough
    int distance;
};

struct suggestion suggest_start(const char *typed);
void suggest_try(struct suggestion *suggestion, const char *word);
// Suggests `word` if the typed word is similar to one of `others`, a list separated by spaces; what follows an equals sign is ignored.
// `others` may be NULL.
void suggest_also(struct suggestion *suggestion, const char *word, const char *others);

#endif
