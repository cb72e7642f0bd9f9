// loop_status.h: the shared state that stops the threads of a parallel loop.
#ifndef LOOP_STATUS_H
#define LOOP_STATUS_H

#include "call_control.h"

struct loop_status {
    struct call_control *call;  // may be NULL
    int stopped, out_of_memory; // set by any thread
};

// Returns false if the call was cancelled, its deadline has passed, or memory is exhausted. Every task calls this
// function first.
static inline bool should_continue(struct loop_status *loop)
{
    if (__atomic_load_n(&loop->stopped, __ATOMIC_RELAXED) || __atomic_load_n(&loop->out_of_memory, __ATOMIC_RELAXED))
        return false;
    if (call_should_continue(loop->call))
        return true;
    __atomic_store_n(&loop->stopped, 1, __ATOMIC_RELAXED);
    return false;
}

static inline void no_memory(struct loop_status *loop) { __atomic_store_n(&loop->out_of_memory, 1, __ATOMIC_RELAXED); }

// Fills the error with the reason why the loop stopped, and returns false. `bytes` is the approximate size of the
// failed allocation.
static inline bool loop_error(struct loop_status *loop, size_t bytes, lam_error *error)
{
    return loop->out_of_memory ? call_memory_error(loop->call, bytes, error) : call_error(loop->call, error);
}

#endif
