// fail.h: fills a lam_error with one sentence that names the file, the position, the value found and the value
// expected.
#ifndef FAIL_H
#define FAIL_H

#include <lambent/base.h>

// Writes the code and the formatted sentence into `error` (which may be NULL) and returns false, so that a function can
// report a failure with `return fail(error, …)`. The text is cleaned and truncated by lam_utf8_show, so that a hostile
// file cannot send control sequences to a terminal.
bool fail(lam_error *error, lam_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

// Reports LAM_MACHINE, because a request for `bytes` bytes of memory failed.
bool fail_memory(lam_error *error, size_t bytes);

// If a reserved word of a parameter struct is not zero, fails with LAM_BAD_ARGUMENT: the program uses a newer header
// and sets a new field (base.h, "Growth").
#define check_reserved(what, params, error)                                                                            \
    reserved_words_are_zero(what, (params)->reserved, sizeof(params)->reserved / sizeof(uint64_t), error)
bool reserved_words_are_zero(const char *what, const uint64_t *words, size_t count, lam_error *error);

#endif
