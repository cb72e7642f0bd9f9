// share.h: selects how much of a large table of cases a test covers. `make test` covers a share in which each row and
// each column of the table still occurs; the tests `more-…` of `make test-more` cover a larger share (LAMBENT_MORE is
// set there), and `long-…` of `make test-long` the whole table (LAMBENT_LONG).
#ifndef SHARE_H
#define SHARE_H

#include <stdbool.h>
#include <stdlib.h>

// True if the whole table is covered.
static inline bool is_long(void) { return getenv("LAMBENT_LONG") != NULL; }

// True in `make test-more` and `make test-long`.
static inline bool is_more(void) { return is_long() || getenv("LAMBENT_MORE") != NULL; }

// Whether a case is selected: every n-th, or each. `number` is the number of the case; for a table of several
// dimensions, it is the sum of its indices, so that every value of an index occurs.
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
