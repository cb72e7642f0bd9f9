// buffer.h: memory that a device keeps from frame to frame and that only grows.
#ifndef BUFFER_H
#define BUFFER_H

#include "call_control.h"

struct buffer {
    void *data; // at least 64-byte aligned
    size_t capacity;
};

// Ensures that the buffer has a capacity of at least `bytes` bytes. The contents are lost if the buffer grows. The
// growth counts towards the call's memory limit. Returns false and fills the error on failure.
bool buffer_reserve(struct buffer *buffer, size_t bytes, struct call_control *call, lam_error *error);
void buffer_free(struct buffer *buffer);

// Frees a buffer that is no longer needed; its bytes no longer count towards the call's memory limit. `call` may be
// NULL.
void buffer_release(struct buffer *buffer, struct call_control *call);

#endif
