// pool.h: a thread pool for parallel loops.
#ifndef POOL_H
#define POOL_H

#include <lambent/base.h>

struct pool;

// Makes a pool of `threads` threads, the caller included (0: one for each processor this process may use). Fewer start
// where the system refuses more; the caller always works. Returns NULL if memory runs out.
struct pool *pool_make(int threads);
void pool_free(struct pool *pool);
int pool_threads(const struct pool *pool); // NULL: 1

// Calls task(user, index, thread) once for each index in [0, count), spread over the pool; returns when all are done.
// `thread` is 0 … pool_threads − 1 and names the thread's own scratch. Indices are handed out in order, one at a time,
// so cut the work into some hundred pieces of a size that does not depend on the thread count. Every thread runs with
// the library's floating-point state (float_state.h). `pool` NULL: the caller runs them all. One pool_run at a time per
// pool.
typedef void pool_task(void *user, size_t index, int thread);
void pool_run(struct pool *pool, size_t count, pool_task *task, void *user);

// Returns the number of processors that this process may use.
int processor_count(void);

#endif
