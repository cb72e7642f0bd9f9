// buffer.h: memory that a device keeps from frame to frame and only ever grows.
#ifndef BUFFER_H
#define BUFFER_H

#include "call_control.h"

struct buffer {
    void *data; // at least 64-byte aligned
    size_t room;
};

// Makes sure of `bytes`; the old contents are lost when it grows. Charges the watch for the growth. False: fills the
// error.
bool buffer_reserve(struct buffer *buffer, size_t bytes, struct call_control *call, lam_error *error);
void buffer_free(struct buffer *buffer);

#endif
