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

void call_start(struct call_control *call, const lam_control *control)
{
    *call = (struct call_control){0};
    if (control) {
        call->control = *control;
        call->unknown_field = !check_reserved("control", control, NULL);
    }
    call->start_ns = now_ns();
}

static bool cancelled(const struct call_control *call)
{
    return call->control.cancel && __atomic_load_n(&call->control.cancel->raised, __ATOMIC_ACQUIRE);
}

static bool over_time(const struct call_control *call)
{
    return call->control.time_limit_s > 0 && (double)(now_ns() - call->start_ns) * 1e-9 > call->control.time_limit_s;
}

bool call_should_continue(struct call_control *call)
{
    return !call || (!cancelled(call) && !over_time(call) && !call->unknown_field);
}

bool call_error(struct call_control *call, lam_error *error)
{
    if (call->unknown_field)
        return check_reserved("control", &call->control, error);
    if (cancelled(call))
        return fail(error, LAM_CANCELLED, "cancelled");
    return fail(error, LAM_LIMIT, "the time limit of %g s is over", call->control.time_limit_s);
}

bool call_charge_spare(struct call_control *call, size_t bytes)
{
    uint64_t limit = call->control.memory_limit_bytes;
    uint64_t used = __atomic_add_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
    if (!limit || used <= limit)
        return true;
    __atomic_sub_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
    return false;
}

bool call_charge(struct call_control *call, size_t bytes)
{
    if (call_charge_spare(call, bytes))
        return true;
    __atomic_store_n(&call->over_memory, 1, __ATOMIC_RELAXED);
    return false;
}

void call_refund(struct call_control *call, size_t bytes)
{
    __atomic_sub_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
}

bool call_memory_error(struct call_control *call, size_t bytes, lam_error *error)
{
    if (call && __atomic_load_n(&call->over_memory, __ATOMIC_RELAXED))
        return fail(error, LAM_LIMIT,
                    "the memory limit of %.1f MB is reached: %.1f MB in use, %.1f MB more needed (--memory-limit)",
                    (double)call->control.memory_limit_bytes / 1e6, (double)call->memory_used / 1e6,
                    (double)bytes / 1e6);
    return fail_memory(error, bytes);
}

static uint64_t or_default(uint64_t limit, uint64_t standard) { return limit ? limit : standard; }

uint64_t call_triangle_limit(const struct call_control *call)
{
    return or_default(call ? call->control.triangle_limit : 0, LAM_TRIANGLE_LIMIT);
}

uint64_t call_pixel_limit(const struct call_control *call)
{
    return or_default(call ? call->control.pixel_limit : 0, LAM_PIXEL_LIMIT);
}

uint64_t call_file_limit(const struct call_control *call)
{
    return or_default(call ? call->control.file_limit_bytes : 0, LAM_FILE_LIMIT_BYTES);
}

unsigned call_json_depth_limit(const struct call_control *call)
{
    uint64_t limit = or_default(call ? call->control.json_depth_limit : 0, LAM_JSON_DEPTH_LIMIT);
    return limit < LAM_JSON_DEPTH_MAX ? (unsigned)limit : LAM_JSON_DEPTH_MAX;
}

bool call_check_triangles(const struct call_control *call, const char *name, uint64_t count, const char *items,
                          lam_error *error)
{
    uint64_t limit = call_triangle_limit(call);
    return count <= limit || fail(error, LAM_LIMIT, "%s: %llu %s, expected at most %llu (--triangle-limit)", name,
                                  (unsigned long long)count, items, (unsigned long long)limit);
}

bool call_check_file(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error)
{
    uint64_t limit = call_file_limit(call);
    return bytes <= limit || fail(error, LAM_LIMIT, "%s: %llu bytes, expected at most %llu (--file-limit)", name,
                                  (unsigned long long)bytes, (unsigned long long)limit);
}

void call_progress(struct call_control *call, double share, const char *step)
{
    if (!call || !call->control.progress)
        return;
    if (share < call->last_share)
        share = call->last_share;
    call->last_share = share;
    call->control.progress(call->control.user, share, step);
}
