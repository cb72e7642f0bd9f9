// call_control.h: enforces the cancel flag, the deadline and the memory budget of lam_control while a call runs, and
// reports the call's progress.
#ifndef CALL_CONTROL_H
#define CALL_CONTROL_H

#include <lambent/base.h>

struct call_control {
    lam_control control; // a copy; if all fields are zero, there are no limits
    uint64_t start_ns;
    uint64_t memory_used; // accessed atomically
    int over_memory;      // set when a request has exceeded the memory budget
    int over_expansion;   // set when a request has exceeded the budget that is derived from the file sizes
    // The latest request that exceeded a budget: the bytes in use, the requested bytes and the limit. Accessed
    // atomically.
    uint64_t refused_used, refused_bytes, refused_limit;
    // The total size in bytes of all files read so far; accessed atomically. If the total size is 0, no file was read,
    // and no limit is derived from file sizes.
    uint64_t input_bytes;
    bool unknown_field; // the control sets a field that this version does not know
    double last_share;
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

// Checks that a model may contain this many objects. Fails with LAM_LIMIT if there are too many.
bool call_check_objects(const struct call_control *call, const char *name, uint64_t count, lam_error *error);

// Checks the size in bytes of a compressed file's data after decompression. Fails with LAM_LIMIT if this size exceeds
// the memory that may be used to read the file.
bool call_check_expanded(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error);

// Checks that a file of this size may be read. Fails with LAM_LIMIT if the file is too large.
bool call_check_file(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error);

// Calls the progress callback. Only the thread that made the call may use this function. The reported progress never
// decreases.
void call_progress(struct call_control *call, double share, const char *step);

// Returns the time of the monotonic clock in nanoseconds.
uint64_t now_ns(void);

#endif
