// console.h: prints messages to standard error, and flushes standard output at the end.
#ifndef CONSOLE_H
#define CONSOLE_H

#include <stdbool.h>
#include <stdio.h>

#include <lambent/base.h>

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

#endif
