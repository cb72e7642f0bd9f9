// console.h: what the program says to people, and the last word on standard output.
#ifndef CONSOLE_H
#define CONSOLE_H

#include <stdbool.h>

#include <lambent/base.h>

// Decides once whether standard error is a terminal that shows colours (NO_COLOR and TERM=dumb switch them off).
void console_start(void);
bool console_is_terminal(void); // standard error is one, and can move its cursor
bool console_has_colors(void);

// One line on standard error: "lambent: …" and "lambent: warning: …".
void say_error(const char *text);
void say_warning(const char *text);
void say_plain(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Fills an error with a printf-like sentence and returns false.
bool complain(lam_error *error, lam_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

// Everything printed on standard output has left the program: false, with LAM_CANNOT_WRITE, if it could not.
bool finish_output(lam_error *error);

#endif
