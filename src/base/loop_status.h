// loop_status.h: how the threads of one parallel loop learn that it must end.
#ifndef LOOP_STATUS_H
#define LOOP_STATUS_H

#include "call_control.h"

struct halt {
    struct watch *watch;        // may be NULL
    int stopped, out_of_memory; // set by any thread
};

// False once the call was cancelled, its time is over, or memory is out; every piece of work asks first.
static inline bool goes_on(struct halt *halt)
{
    if (__atomic_load_n(&halt->stopped, __ATOMIC_RELAXED) || __atomic_load_n(&halt->out_of_memory, __ATOMIC_RELAXED))
        return false;
    if (watch_on(halt->watch))
        return true;
    __atomic_store_n(&halt->stopped, 1, __ATOMIC_RELAXED);
    return false;
}

static inline void no_memory(struct halt *halt) { __atomic_store_n(&halt->out_of_memory, 1, __ATOMIC_RELAXED); }

// Fills the error with the reason and returns false. `bytes`: about what could not be had.
static inline bool halt_error(struct halt *halt, size_t bytes, lam_error *error)
{
    return halt->out_of_memory ? watch_memory_error(halt->watch, bytes, error) : watch_error(halt->watch, error);
}

#endif
