// parallel_rows.c: processes a file's rows in parallel chunks. The reported error does not depend on the number of
// threads.
#include "parallel_rows.h"

struct run {
    const struct import_source *source;
    parallel_rows_task *task;        // set by parallel_rows_run
    parallel_bytes_task *bytes_task; // set by parallel_rows_read
    void *user;
    const struct row_bytes *rows;
    uint8_t *buffers;    // if the bytes are not in memory, each thread has a buffer of PARALLEL_ROWS rows
    size_t first_failed; // atomic; the index of the first chunk that failed, or `count`
    int stopped;         // atomic; the call was cancelled or ran out of time
};

static bool run_task(const struct run *run, size_t index, int thread, lam_error *error)
{
    const struct row_bytes *rows = run->rows;
    size_t first, last;
    if (!rows)
        return run->task(run->user, index, error);
    parallel_rows_range(rows->count, index, &first, &last);
    size_t offset = first * rows->stride;
    if (!run->buffers) {
        const uint8_t *begin = rows->memory ? rows->memory : run->source->parts.memory + rows->offset;
        return run->bytes_task(run->user, index, begin + offset, error);
    }
    uint8_t *buffer = run->buffers + (size_t)thread * PARALLEL_ROWS * rows->stride;
    return file_read_part(&run->source->parts, run->source->name, rows->offset + offset, buffer,
                          (last - first) * rows->stride, error) &&
           run->bytes_task(run->user, index, buffer, error);
}

static void run_one(void *user, size_t index, int thread)
{
    struct run *run = user;
    // Chunks after a failed chunk are skipped, because only the first error is reported.
    size_t failed = __atomic_load_n(&run->first_failed, __ATOMIC_RELAXED);
    if (index > failed || __atomic_load_n(&run->stopped, __ATOMIC_RELAXED))
        return;
    if (!call_should_continue(run->source->call)) {
        __atomic_store_n(&run->stopped, 1, __ATOMIC_RELAXED);
        return;
    }
    if (run_task(run, index, thread, NULL))
        return;
    while (index < failed &&
           !__atomic_compare_exchange_n(&run->first_failed, &failed, index, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        ;
}

static bool run_all(struct run *run, size_t count, lam_error *error)
{
    run->first_failed = count;
    pool_run(run->source->pool, count, run_one, run);
    if (run->stopped)
        return call_error(run->source->call, error);
    // Chunks after the first failed chunk may have been skipped. If the failed chunk succeeds now (for example, because
    // memory is available again), the skipped chunks must also be processed.
    for (size_t index = run->first_failed; index < count; index++) {
        if (!run_task(run, index, 0, error))
            return false;
    }
    return true;
}

bool parallel_rows_run(const struct import_source *source, size_t count, parallel_rows_task *task, void *user,
                       lam_error *error)
{
    struct run run = {.source = source, .task = task, .user = user};
    return run_all(&run, count, error);
}

bool parallel_rows_read(const struct import_source *source, const struct row_bytes *rows, parallel_bytes_task *task,
                        void *user, lam_error *error)
{
    struct run run = {.source = source, .bytes_task = task, .user = user, .rows = rows};
    struct arena scratch;
    arena_start(&scratch, NULL); // the threads' buffers are not counted, because the number of threads varies
    bool done = true;
    if (!source->parts.memory && !rows->memory) {
        size_t bytes = PARALLEL_ROWS * rows->stride, threads = (size_t)pool_threads(source->pool);
        run.buffers = arena_array(&scratch, threads, bytes);
        done = run.buffers || call_memory_error(source->call, threads * bytes, error);
    }
    done = done && run_all(&run, parallel_rows_count(rows->count), error);
    arena_free(&scratch);
    return done;
}

const uint8_t *parallel_rows_rest(const struct import_source *source, size_t offset, struct arena *arena,
                                  lam_error *error)
{
    struct file_bytes rest;
    if (source->parts.memory)
        return source->parts.memory + offset;
    if (!file_read_rest(&source->parts, source->name, offset, source->pool, source->call, &rest, error))
        return NULL;
    const uint8_t *bytes = rest.data;
    if (file_move_to_arena(&rest, arena))
        return bytes;
    file_release(&rest);
    return call_memory_error(source->call, source->parts.size - offset, error), NULL;
}
