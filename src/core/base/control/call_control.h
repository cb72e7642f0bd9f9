// call_control.h: enforces the cancel flag, the deadline and the memory budget of lam_control while a call runs, and
// reports the call's progress.
#ifndef CALL_CONTROL_H
#define CALL_CONTROL_H

#include <lambent/base.h>

// The budgets of a call: memory_limit_bytes, the memory that is derived from the file sizes, and the total of all bytes
// that are unpacked.
enum call_budget { NO_BUDGET, MEMORY_BUDGET, EXPANSION_BUDGET, TOTAL_BUDGET };

struct call_control {
    lam_control control; // a copy; if all fields are zero, there are no limits
    uint64_t start_ns;
    uint64_t memory_used; // accessed atomically
    // The total number of bytes that were charged or unpacked, released memory included. Accessed atomically.
    uint64_t unpacked;
    // The latest request that exceeded a budget: the budget, the bytes in use, the requested bytes and the limit.
    // Accessed atomically.
    int refused; // enum call_budget
    uint64_t refused_used, refused_bytes, refused_limit;
    // While tasks run together (call_together): the state of the call, the refunds that are still to be made (both
    // accessed atomically), and the counts from before.
    enum { CALL_ALONE, CALL_TOGETHER, CALL_STOPPED } together;
    uint64_t refunds, memory_before, unpacked_before;
    // The total size in bytes of all files read so far; accessed atomically. If the total size is 0, no file was read,
    // and no limit is derived from file sizes.
    uint64_t input_bytes;
    bool unknown_field; // the control sets a field that this version does not know
    double last_share;
    // The part of the call that reports progress now: it begins at `part_begin`, and `part_rest` follows or precedes.
    double part_begin, part_rest;
    // The number of operations in the formulas of a scene file, and the maximum number; 0 means no limit.
    uint64_t operations, operation_limit;
};

// Starts a call. `control` may be NULL.
void call_start(struct call_control *call, const lam_control *control);

// Returns false if the call must stop: it was cancelled, it exceeded its time limit, or its control sets a field that
// this version does not know. The check takes about 25 ns, so loops can repeat it every few thousand items. Any thread
// may call this function. `call` may be NULL.
bool call_should_continue(struct call_control *call);

// Fills the error with the reason why call_should_continue returned false, and returns false.
bool call_error(struct call_control *call, lam_error *error);

// call_charge counts memory towards the call's memory budget, and call_refund subtracts it again. call_charge returns
// false if the memory exceeds the budget. Any thread may call these functions.
bool call_charge(struct call_control *call, size_t bytes);
// Works like call_charge, but for memory that the call can do without: if the memory exceeds the budget, the call still
// continues.
bool call_charge_spare(struct call_control *call, size_t bytes);
void call_refund(struct call_control *call, size_t bytes);
// Returns how many bytes call_charge would still accept, for the limit of another process.
uint64_t call_memory_left(const struct call_control *call);

// Tasks that run together would charge their memory in a random order. Between call_together and call_apart, refunds are
// therefore postponed. If the sum of all charges is within the budget, then so is each order of the tasks. Otherwise the
// caller discards the results, and runs the tasks one after another, so that the order and the number of threads never
// decide whether the call succeeds. call_stop_together makes call_should_continue return false until call_apart, and
// call_apart returns whether it was called. In this case call_apart also restores the counts of memory from before
// call_together.
void call_together(struct call_control *call);
void call_stop_together(struct call_control *call);
bool call_apart(struct call_control *call);

// Reports a failed allocation: either it exceeds the budget, or memory has run out. Returns false.
bool call_memory_error(struct call_control *call, size_t bytes, lam_error *error);

// Adds `bytes` to the total size of the files that the call reads. A file that is read twice is added only once. Any
// thread may call this function; `call` may be NULL.
void call_add_input(struct call_control *call, uint64_t bytes);
uint64_t call_input_bytes(const struct call_control *call);

// These functions return the limits of lam_control, or their defaults. UINT64_MAX means no limit. `call` may be NULL.
uint64_t call_triangle_limit(const struct call_control *call);
uint64_t call_expansion_limit(const struct call_control *call);
uint64_t call_pixel_limit(const struct call_control *call);
unsigned call_json_depth_limit(const struct call_control *call);
uint64_t call_layer_limit(const struct call_control *call);

// Checks that a model or a rendered scene may contain this many triangles. Fails with LAM_LIMIT if there are too many.
// `items` is the name of the primitives in the message, for example "triangles" or "lines".
bool call_check_triangles(const struct call_control *call, const char *name, uint64_t count, const char *items,
                          lam_error *error);

// Checks a number of items that drawing adds to the scene. Does nothing if the caller set the limit of triangles.
bool call_check_unfolded(const struct call_control *call, uint64_t count, const char *items, lam_error *error);

// Checks that a model may contain this many objects. Fails with LAM_LIMIT if there are too many.
bool call_check_objects(const struct call_control *call, const char *name, uint64_t count, lam_error *error);

// Counts bytes that a decoder produces or reads again without charging memory for them. Like the bytes that call_charge
// counts, they add to a total that is never reduced. Fails with LAM_LIMIT if this total exceeds its limit: four bytes
// for each pixel of the largest picture, or the memory that may be used to read the files, whichever is larger.
bool call_unpack(struct call_control *call, uint64_t bytes, lam_error *error);

// Checks that a file of this size may be read. Fails with LAM_LIMIT if the file is too large.
bool call_check_file(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error);

// Calls the progress callback. Only the thread that made the call may use this function. The reported progress never
// decreases.
void call_progress(struct call_control *call, double share, const char *step);

// Returns the time of the monotonic clock in nanoseconds.
uint64_t now_ns(void);

#endif
