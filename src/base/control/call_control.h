// call_control.h: enforces lam_control while a call runs: cancel flag, deadline, memory budget and progress.
#ifndef CALL_CONTROL_H
#define CALL_CONTROL_H

#include <lambent/base.h>

struct call_control {
    lam_control control; // a copy; if all fields are zero, there are no limits
    uint64_t start_ns;
    uint64_t memory_used; // accessed atomically
    int over_memory;      // set when the memory budget has refused a request
    int over_expansion;   // set when the budget derived from the file sizes has refused a request
    // The latest request that a budget refused: the bytes in use, the bytes requested and the limit. Accessed
    // atomically.
    uint64_t refused_used, refused_bytes, refused_limit;
    // The number of bytes in all files read so far, accessed atomically. 0 means that no files were read, and that no
    // limit is derived from them.
    uint64_t input_bytes;
    bool unknown_field; // the control has a field that this version does not know
    double last_share;
    // The number of formula operations in a scene file, and its limit; 0 means no limit.
    uint64_t operations, operation_limit;
};

// Starts a call. `control` may be NULL.
void call_start(struct call_control *call, const lam_control *control);

// Returns false if the call must stop: it was cancelled, it exceeded its time, or its control sets a field that this
// version does not know. It is cheap enough to call every few thousand items (about 25 ns), from any thread. `call` may
// be NULL.
bool call_should_continue(struct call_control *call);

// Fills the error with the reason why call_should_continue returned false, and returns false.
bool call_error(struct call_control *call, lam_error *error);

// Charges and refunds memory. Returns false if the budget is exceeded. Any thread may call it.
bool call_charge(struct call_control *call, size_t bytes);
// Charges memory that the call does not strictly need: a refusal does not end the call.
bool call_charge_spare(struct call_control *call, size_t bytes);
void call_refund(struct call_control *call, size_t bytes);

// Reports an allocation that failed: over the budget, or out of memory. Returns false.
bool call_memory_error(struct call_control *call, size_t bytes, lam_error *error);

// Adds to the size of the files that the call reads; a file that is read twice counts once. Any thread may call it;
// `call` may be NULL.
void call_add_input(struct call_control *call, uint64_t bytes);
uint64_t call_input_bytes(const struct call_control *call);

// Return the limits of lam_control, or their defaults. UINT64_MAX means no limit. `call` may be NULL.
uint64_t call_triangle_limit(const struct call_control *call);
uint64_t call_expansion_limit(const struct call_control *call);
uint64_t call_pixel_limit(const struct call_control *call);
uint64_t call_file_limit(const struct call_control *call);
unsigned call_json_depth_limit(const struct call_control *call);
uint64_t call_layer_limit(const struct call_control *call);

// Returns whether a model or a drawn scene may have this many triangles. Otherwise fails with LAM_LIMIT. `items` names
// them in the message: "triangles", "lines".
bool call_check_triangles(const struct call_control *call, const char *name, uint64_t count, const char *items,
                          lam_error *error);

// Returns whether a model may have this many objects. Otherwise fails with LAM_LIMIT.
bool call_check_objects(const struct call_control *call, const char *name, uint64_t count, lam_error *error);

// Returns whether the unpacked data of a compressed file may have this many bytes, which is the memory that reading the
// file may use. Otherwise fails with LAM_LIMIT.
bool call_check_expanded(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error);

// Returns whether a file of this size may be read. Otherwise fails with LAM_LIMIT.
bool call_check_file(const struct call_control *call, const char *name, uint64_t bytes, lam_error *error);

// Calls the progress callback. It must run in the calling thread only. Reported shares never decrease.
void call_progress(struct call_control *call, double share, const char *step);

// Returns the monotonic time.
uint64_t now_ns(void);

#endif
