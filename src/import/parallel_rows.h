// parallel_rows.h: a loop over a file's rows in parallel pieces, whose errors do not depend on the threads.
#ifndef PARALLEL_ROWS_H
#define PARALLEL_ROWS_H

#include "importer.h"

// Rows (facets, vertices, faces) of one piece. A piece of the usual formats stays within a second-level cache.
enum { PARALLEL_ROWS = 4096 };

static inline size_t parallel_rows_count(size_t rows) { return rows / PARALLEL_ROWS + (rows % PARALLEL_ROWS != 0); }

// The rows of piece `index`: [*first, *last).
static inline void parallel_rows_range(size_t rows, size_t index, size_t *first, size_t *last)
{
    *first = index * PARALLEL_ROWS;
    *last = rows - *first < PARALLEL_ROWS ? rows : *first + PARALLEL_ROWS;
}

// Does piece `index`. False: something is wrong in it; then `error`, which may be NULL, says what came first.
// A piece may be done twice. The flag and the deadline are looked at between pieces.
typedef bool parallel_rows_task(void *user, size_t index, lam_error *error);

// Does pieces 0 … count − 1 on the source's pool. If some are wrong, the first of them is done again on the
// calling thread to fill `error`, so that a file's first mistake is the one that is told. Also false where
// the watch ends the call.
bool parallel_rows_run(const struct import_source *source, size_t count, parallel_rows_task *task, void *user,
                       lam_error *error);

#endif
