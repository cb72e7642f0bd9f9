// call_control.c: enforces lam_control while a call runs.
#include "call_control.h"

#include "fail.h"

#include <stdio.h>
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
    return !call || (!cancelled(call) && !over_time(call) && !call->unknown_field &&
                     __atomic_load_n(&call->together, __ATOMIC_RELAXED) != CALL_STOPPED);
}

bool call_error(struct call_control *call, lam_error *error)
{
    if (call->unknown_field)
        return check_reserved("control", &call->control, error);
    if (cancelled(call))
        return fail(error, LAM_CANCELLED, "cancelled");
    return fail(error, LAM_LIMIT, "the time limit of %g s is over", call->control.time_limit_s);
}

static uint64_t or_default(uint64_t limit, uint64_t standard) { return limit ? limit : standard; }

// Computes base + bytes · rate, without overflow.
static uint64_t grown(uint64_t base, uint64_t bytes, uint64_t rate)
{
    uint64_t sum;
    return __builtin_mul_overflow(bytes, rate, &sum) || __builtin_add_overflow(sum, base, &sum) ? UINT64_MAX : sum;
}

void call_add_input(struct call_control *call, uint64_t bytes)
{
    if (call)
        __atomic_add_fetch(&call->input_bytes, bytes, __ATOMIC_RELAXED);
}

uint64_t call_input_bytes(const struct call_control *call)
{
    return call ? __atomic_load_n(&call->input_bytes, __ATOMIC_RELAXED) : 0;
}

uint64_t call_expansion_limit(const struct call_control *call)
{
    return or_default(call ? call->control.expansion_limit : 0, LAM_EXPANSION_LIMIT);
}

// Returns the number of bytes of memory that may be used to read files of this size.
static uint64_t expansion_bytes(const struct call_control *call)
{
    uint64_t bytes = call_input_bytes(call);
    return bytes ? grown(LAM_EXPANSION_BASE_BYTES, bytes, call_expansion_limit(call)) : UINT64_MAX;
}

bool call_charge_spare(struct call_control *call, size_t bytes)
{
    uint64_t limit = call->control.memory_limit_bytes;
    uint64_t used = __atomic_add_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
    if ((!limit || used <= limit) && used <= expansion_bytes(call))
        return true;
    __atomic_sub_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
    return false;
}

uint64_t call_memory_left(const struct call_control *call)
{
    uint64_t limit = call->control.memory_limit_bytes, most = expansion_bytes(call), used = call->memory_used;
    most = limit && limit < most ? limit : most;
    return most == UINT64_MAX ? most : most > used ? most - used : 0;
}

static void note_refusal(struct call_control *call, enum call_budget budget, uint64_t used, uint64_t bytes,
                         uint64_t limit)
{
    __atomic_store_n(&call->refused_used, used, __ATOMIC_RELAXED);
    __atomic_store_n(&call->refused_bytes, bytes, __ATOMIC_RELAXED);
    __atomic_store_n(&call->refused_limit, limit, __ATOMIC_RELAXED);
    __atomic_store_n(&call->refused, (int)budget, __ATOMIC_RELAXED);
}

// Adds to the total of all unpacked bytes.
static bool add_unpacked(struct call_control *call, uint64_t bytes)
{
    uint64_t files = expansion_bytes(call), pixels = grown(0, call_pixel_limit(call), 4);
    uint64_t limit = files > pixels ? files : pixels;
    uint64_t total = __atomic_add_fetch(&call->unpacked, bytes, __ATOMIC_RELAXED);
    // Results of tasks that run together may be discarded, so these tasks may use only half of the limit.
    if (total <= (__atomic_load_n(&call->together, __ATOMIC_RELAXED) ? limit / 2 : limit))
        return true;
    note_refusal(call, TOTAL_BUDGET, total - bytes, bytes, limit);
    return false;
}

bool call_charge(struct call_control *call, size_t bytes)
{
    if (call_charge_spare(call, bytes)) {
        if (add_unpacked(call, bytes))
            return true;
        __atomic_sub_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
        return false;
    }
    uint64_t limit = call->control.memory_limit_bytes, used = __atomic_load_n(&call->memory_used, __ATOMIC_RELAXED);
    bool plain = limit && used + bytes > limit;
    note_refusal(call, plain ? MEMORY_BUDGET : EXPANSION_BUDGET, used, bytes, plain ? limit : expansion_bytes(call));
    return false;
}

void call_refund(struct call_control *call, size_t bytes)
{
    if (__atomic_load_n(&call->together, __ATOMIC_RELAXED))
        __atomic_add_fetch(&call->refunds, bytes, __ATOMIC_RELAXED);
    else
        __atomic_sub_fetch(&call->memory_used, bytes, __ATOMIC_RELAXED);
}

void call_together(struct call_control *call)
{
    call->together = CALL_TOGETHER;
    call->refunds = 0;
    call->memory_before = call->memory_used;
    call->unpacked_before = call->unpacked;
}

void call_stop_together(struct call_control *call)
{
    __atomic_store_n(&call->together, CALL_STOPPED, __ATOMIC_RELAXED);
}

bool call_apart(struct call_control *call)
{
    bool stopped = call->together == CALL_STOPPED;
    call->memory_used = stopped ? call->memory_before : call->memory_used - call->refunds;
    call->unpacked = stopped ? call->unpacked_before : call->unpacked;
    call->together = CALL_ALONE;
    return stopped;
}

bool call_memory_error(struct call_control *call, size_t bytes, lam_error *error)
{
    int budget = call ? __atomic_load_n(&call->refused, __ATOMIC_RELAXED) : NO_BUDGET;
    if (budget == NO_BUDGET)
        return fail_memory(error, bytes);
    double used = (double)call->refused_used / 1e6, more = (double)call->refused_bytes / 1e6;
    double limit = (double)call->refused_limit / 1e6;
    if (budget == MEMORY_BUDGET)
        return fail(error, LAM_LIMIT,
                    "the memory limit of %.1f MB is reached: %.1f MB in use, %.1f MB more needed "
                    "(lam_control.memory_limit_bytes)",
                    limit, used, more);
    return fail(error, LAM_LIMIT,
                "%.1f MB %s, expected at most %.1f MB for files of %llu bytes (lam_control.expansion_limit)",
                used + more, budget == TOTAL_BUDGET ? "are unpacked in total" : "of memory are needed", limit,
                (unsigned long long)call_input_bytes(call));
}

uint64_t call_triangle_limit(const struct call_control *call)
{
    uint64_t given = call ? call->control.triangle_limit : 0, bytes = call_input_bytes(call);
    uint64_t limit = bytes ? grown(LAM_TRIANGLES_BASE, bytes, LAM_TRIANGLES_PER_BYTE) : LAM_TRIANGLE_LIMIT;
    return or_default(given, limit < LAM_TRIANGLE_LIMIT ? limit : LAM_TRIANGLE_LIMIT);
}

uint64_t call_pixel_limit(const struct call_control *call)
{
    return or_default(call ? call->control.pixel_limit : 0, LAM_PIXEL_LIMIT);
}

unsigned call_json_depth_limit(const struct call_control *call)
{
    uint64_t limit = or_default(call ? call->control.json_depth_limit : 0, LAM_JSON_DEPTH_LIMIT);
    return limit < LAM_JSON_DEPTH_MAX ? (unsigned)limit : LAM_JSON_DEPTH_MAX;
}

uint64_t call_layer_limit(const struct call_control *call)
{
    uint64_t given = call ? call->control.layer_limit : 0, bytes = call_input_bytes(call);
    return or_default(given, bytes ? LAM_LAYERS_BASE + bytes / LAM_LAYER_BYTES : UINT64_MAX);
}

// Returns the end of an error message about a limit that was derived from the size of the files. Returns "" if the
// caller set the limit.
static const char *for_files(const struct call_control *call, uint64_t given, char text[48])
{
    uint64_t bytes = given ? 0 : call_input_bytes(call);
    text[0] = '\0';
    if (bytes)
        snprintf(text, 48, " for files of %llu bytes", (unsigned long long)bytes);
    return text;
}

bool call_check_objects(const struct call_control *call, const char *name, uint64_t count, lam_error *error)
{
    uint64_t given = call ? call->control.object_limit : 0, bytes = call_input_bytes(call);
    uint64_t limit = or_default(given, bytes ? grown(LAM_OBJECTS_BASE, bytes, 1) : UINT64_MAX);
    char text[48];
    return count <= limit ||
           fail(error, LAM_LIMIT, "%s: %llu objects, expected at most %llu%s (lam_control.object_limit)", name,
                (unsigned long long)count, (unsigned long long)limit, for_files(call, given, text));
}

bool call_check_triangles(const struct call_control *call, const char *name, uint64_t count, const char *items,
                          lam_error *error)
{
    uint64_t limit = call_triangle_limit(call), given = call ? call->control.triangle_limit : 0;
    char text[48];
    return count <= limit || fail(error, LAM_LIMIT, "%s: %llu %s, expected at most %llu%s (lam_control.triangle_limit)",
                                  name, (unsigned long long)count, items, (unsigned long long)limit,
                                  for_files(call, limit < LAM_TRIANGLE_LIMIT ? given : 1, text));
}

bool call_check_unfolded(const struct call_control *call, uint64_t count, const char *items, lam_error *error)
{
    return !call || call->control.triangle_limit || call_triangle_limit(call) == LAM_TRIANGLE_LIMIT ||
           call_check_triangles(call, "the scene", count, items, error);
}

bool call_unpack(struct call_control *call, uint64_t bytes, lam_error *error)
{
    return !call || add_unpacked(call, bytes) || call_memory_error(call, bytes, error);
}

bool call_check_file(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error)
{
    uint64_t limit = or_default(call ? call->control.file_limit_bytes : 0, LAM_FILE_LIMIT_BYTES);
    return bytes <= limit ||
           fail(error, LAM_LIMIT, "%s: %llu bytes, expected at most %llu (lam_control.file_limit_bytes)", name,
                (unsigned long long)bytes, (unsigned long long)limit);
}

void call_progress(struct call_control *call, double share, const char *step)
{
    if (!call || !call->control.progress)
        return;
    share = call->part_begin + (1 - call->part_rest) * share;
    if (share < call->last_share)
        share = call->last_share;
    call->last_share = share;
    call->control.progress(call->control.user, share, step);
}
