// fail.h: fills a lam_error. One sentence: file, place, found, expected.
#ifndef FAIL_H
#define FAIL_H

#include <lambent/base.h>

// Writes the code and the formatted sentence into `error` (NULL is fine) and returns false, so that a failing function
// ends in `return fail(error, …)`. Control characters in the text become '?', so a file name or a token from a hostile
// file cannot play with a terminal. A sentence that is too long is cut at a character's boundary, ending in "…".
bool fail(lam_error *error, lam_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

// Out of memory: LAM_LIMIT, naming the size of the request.
bool fail_memory(lam_error *error, size_t bytes);

// Refuses a struct of parameters with a field from a newer header: false, and LAM_BAD_ARGUMENT, where a reserved word is
// not zero (base.h, "Growth").
#define check_reserved(what, params, error)                                                                            \
    reserved_words_are_zero(what, (params)->reserved, sizeof(params)->reserved / sizeof(uint64_t), error)
bool reserved_words_are_zero(const char *what, const uint64_t *words, size_t count, lam_error *error);

#endif
