// parallel_rows.h: processes a file's rows in parallel chunks. The reported error does not depend on the number of
// threads.
#ifndef PARALLEL_ROWS_H
#define PARALLEL_ROWS_H

#include "importer.h"

// Rows (facets, vertices, faces) per chunk. In the usual formats, a chunk fits into the second-level cache.
enum { PARALLEL_ROWS = THRESHOLD(4096, 16) };

static inline size_t parallel_rows_count(size_t rows) { return rows / PARALLEL_ROWS + (rows % PARALLEL_ROWS != 0); }

// Gets the rows of chunk `index`: [*first, *last).
static inline void parallel_rows_range(size_t rows, size_t index, size_t *first, size_t *last)
{
    *first = index * PARALLEL_ROWS;
    *last = rows - *first < PARALLEL_ROWS ? rows : *first + PARALLEL_ROWS;
}

// A task that processes chunk `index`. The task may run twice for the same chunk. Returns false if the chunk contains
// an error; `error` (may be NULL) then describes the first error in the chunk. The call's cancellation and deadline are
// checked between chunks.
typedef bool parallel_rows_task(void *user, size_t index, lam_error *error);

// Runs the task for chunks 0 … count − 1 on the source's pool. If some chunks fail, the first of them is processed
// again on the calling thread to fill `error`, so that the file's first error is reported. Also returns false if the
// call is cancelled.
bool parallel_rows_run(const struct import_source *source, size_t count, parallel_rows_task *task, void *user,
                       lam_error *error);

// Rows of `stride` bytes each: in memory, or at `offset` in the file if `memory` is NULL.
struct row_bytes {
    const uint8_t *memory;
    size_t offset, stride, count;
};

// Like parallel_rows_task, but also receives the bytes of the chunk's rows. If they are not in memory, `rows` points to
// a buffer of the thread.
typedef bool parallel_bytes_task(void *user, size_t index, const uint8_t *rows, lam_error *error);

// Runs the task for each chunk of the rows. The rows must be inside the file.
bool parallel_rows_read(const struct import_source *source, const struct row_bytes *rows, parallel_bytes_task *task,
                        void *user, lam_error *error);

// Returns the bytes from `offset` to the end of the file. If they are not in memory, they are read into `arena`.
// Returns NULL on error.
const uint8_t *parallel_rows_rest(const struct import_source *source, size_t offset, struct arena *arena,
                                  lam_error *error);

#endif
