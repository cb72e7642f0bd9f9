// call_control.c: the running side of lam_control.
#include "call_control.h"

#include "fail.h"

#include <time.h>

uint64_t now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

void lam_cancel_raise(lam_cancel *cancel)
{
    if (cancel)
        __atomic_store_n(&cancel->raised, 1, __ATOMIC_RELEASE);
}

void lam_cancel_clear(lam_cancel *cancel)
{
    if (cancel)
        __atomic_store_n(&cancel->raised, 0, __ATOMIC_RELEASE);
}

void watch_start(struct watch *watch, const lam_control *control)
{
    *watch = (struct watch){0};
    if (control)
        watch->control = *control;
    watch->start_ns = now_ns();
}

static bool cancelled(const struct watch *watch)
{
    return watch->control.cancel && __atomic_load_n(&watch->control.cancel->raised, __ATOMIC_ACQUIRE);
}

static bool over_time(const struct watch *watch)
{
    return watch->control.time_limit_s > 0 && (double)(now_ns() - watch->start_ns) * 1e-9 > watch->control.time_limit_s;
}

bool watch_on(struct watch *watch) { return !watch || (!cancelled(watch) && !over_time(watch)); }

bool watch_error(struct watch *watch, lam_error *error)
{
    if (cancelled(watch))
        return fail(error, LAM_CANCELLED, "cancelled");
    return fail(error, LAM_LIMIT, "the time limit of %g s is over", watch->control.time_limit_s);
}

bool watch_charge(struct watch *watch, size_t bytes)
{
    uint64_t limit = watch->control.memory_limit_bytes;
    uint64_t used = __atomic_add_fetch(&watch->memory_used, bytes, __ATOMIC_RELAXED);
    if (!limit || used <= limit)
        return true;
    __atomic_sub_fetch(&watch->memory_used, bytes, __ATOMIC_RELAXED);
    __atomic_store_n(&watch->over_memory, 1, __ATOMIC_RELAXED);
    return false;
}

void watch_refund(struct watch *watch, size_t bytes)
{
    __atomic_sub_fetch(&watch->memory_used, bytes, __ATOMIC_RELAXED);
}

bool watch_memory_error(struct watch *watch, size_t bytes, lam_error *error)
{
    if (watch && __atomic_load_n(&watch->over_memory, __ATOMIC_RELAXED))
        return fail(error, LAM_LIMIT, "the memory limit of %.1f MB is reached: %.1f MB in use, %.1f MB more needed",
                    (double)watch->control.memory_limit_bytes / 1e6, (double)watch->memory_used / 1e6,
                    (double)bytes / 1e6);
    return fail_memory(error, bytes);
}

void watch_progress(struct watch *watch, double share, const char *step)
{
    if (!watch || !watch->control.progress)
        return;
    if (share < watch->last_share)
        share = watch->last_share;
    watch->last_share = share;
    watch->control.progress(watch->control.user, share, step);
}
