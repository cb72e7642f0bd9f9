// parallel_rows.c: a loop over a file's rows in parallel pieces, whose errors do not depend on the threads.
#include "parallel_rows.h"

struct run {
    const struct import_source *source;
    parallel_rows_task *task;
    void *user;
    size_t first_wrong; // touched atomically; the count while all is well
    int stopped;        // touched atomically; the watch has said no
};

static void run_one(void *user, size_t index, int thread)
{
    (void)thread;
    struct run *run = user;
    // Pieces behind a known mistake cannot change the outcome.
    size_t wrong = __atomic_load_n(&run->first_wrong, __ATOMIC_RELAXED);
    if (index > wrong || __atomic_load_n(&run->stopped, __ATOMIC_RELAXED))
        return;
    if (!call_should_continue(run->source->call)) {
        __atomic_store_n(&run->stopped, 1, __ATOMIC_RELAXED);
        return;
    }
    if (run->task(run->user, index, NULL))
        return;
    while (index < wrong &&
           !__atomic_compare_exchange_n(&run->first_wrong, &wrong, index, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        ;
}

bool parallel_rows_run(const struct import_source *source, size_t count, parallel_rows_task *task, void *user,
                       lam_error *error)
{
    struct run run = {.source = source, .task = task, .user = user, .first_wrong = count};
    pool_run(source->pool, count, run_one, &run);
    if (run.stopped)
        return call_error(source->call, error);
    // Pieces behind the first wrong one may not have been done: if it goes well now (memory was short, and no
    // longer is), they still have to be.
    for (size_t index = run.first_wrong; index < count; index++) {
        if (!task(user, index, error))
            return false;
    }
    return true;
}
