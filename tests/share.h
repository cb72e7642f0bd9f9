// share.h: how much of a large table of cases a test goes through. `make test` takes a share, in which each row and each
// column of the table still occurs; the tests `long-…` of `make test-long` go through all of it (LAMBENT_LONG is set there).
#ifndef SHARE_H
#define SHARE_H

#include <stdbool.h>
#include <stdlib.h>

// True where the whole table is gone through.
static inline bool is_long(void) { return getenv("LAMBENT_LONG") != NULL; }

// Whether a case is taken: every n-th, or each. `number` is the case's own; for a table of several dimensions the sum of its
// indices, so that no value of an index is left out.
static inline bool is_taken(size_t number, size_t n) { return is_long() || number % n == 0; }

// Sanitizers and builds without optimization take many times as long.
#if defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IS_SLOW_BUILD true
#endif
#endif
#if !defined IS_SLOW_BUILD && !defined __OPTIMIZE__
#define IS_SLOW_BUILD true
#endif
#ifndef IS_SLOW_BUILD
#define IS_SLOW_BUILD false
#endif

#endif
