// parallel_rows.c: processes a file's rows in parallel chunks, with errors that do not depend on the threads.
#include "parallel_rows.h"

struct run {
    const struct import_source *source;
    parallel_rows_task *task;
    void *user;
    size_t first_failed; // atomic; the lowest chunk that failed, or `count`
    int stopped;         // atomic; the call was cancelled or ran out of time
};

static void run_one(void *user, size_t index, int thread)
{
    (void)thread;
    struct run *run = user;
    // Chunks after a failed one cannot change the result.
    size_t failed = __atomic_load_n(&run->first_failed, __ATOMIC_RELAXED);
    if (index > failed || __atomic_load_n(&run->stopped, __ATOMIC_RELAXED))
        return;
    if (!call_should_continue(run->source->call)) {
        __atomic_store_n(&run->stopped, 1, __ATOMIC_RELAXED);
        return;
    }
    if (run->task(run->user, index, NULL))
        return;
    while (index < failed &&
           !__atomic_compare_exchange_n(&run->first_failed, &failed, index, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        ;
}

bool parallel_rows_run(const struct import_source *source, size_t count, parallel_rows_task *task, void *user,
                       lam_error *error)
{
    struct run run = {.source = source, .task = task, .user = user, .first_failed = count};
    pool_run(source->pool, count, run_one, &run);
    if (run.stopped)
        return call_error(source->call, error);
    // Chunks after the first failed one may have been skipped. If it succeeds now, because memory is available again,
    // they must still run.
    for (size_t index = run.first_failed; index < count; index++) {
        if (!task(user, index, error))
            return false;
    }
    return true;
}
