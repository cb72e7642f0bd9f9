// pool.h: a thread pool for parallel loops.
#ifndef POOL_H
#define POOL_H

#include <lambent/base.h>

struct pool;

// Makes a pool of `threads` threads, including the caller (0 means one for each processor that this process may use).
// The pool has fewer threads if the system refuses to create more. The calling thread always runs tasks too. Returns
// NULL if memory runs out.
struct pool *pool_make(int threads);
void pool_free(struct pool *pool);
int pool_threads(const struct pool *pool);          // 1 if `pool` is NULL
void pool_set_alone(struct pool *pool, bool alone); // while `alone` is set, only the caller runs tasks

// Calls task(user, index, thread) once for each index in [0, count), distributed over the threads of the pool, and
// returns when all calls are done. `thread` is 0 … pool_threads − 1 and selects the thread's own scratch memory.
// Threads take the indices in order, one at a time. The caller should therefore divide the work into a few hundred
// tasks whose size does not depend on the thread count. Every thread runs with the library's floating-point state
// (float_state.h). If `pool` is NULL, the calling thread runs all tasks. Only one pool_run may run on a pool at a time.
typedef void pool_task(void *user, size_t index, int thread);
void pool_run(struct pool *pool, size_t count, pool_task *task, void *user);

#endif
