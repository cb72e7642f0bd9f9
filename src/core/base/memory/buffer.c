// buffer.c: memory that a device keeps from frame to frame and that only grows.
#include "buffer.h"

#include "pages.h"

bool buffer_reserve(struct buffer *buffer, size_t bytes, struct call_control *call, lam_error *error)
{
    if (bytes <= buffer->capacity)
        return true;
    size_t old = buffer->capacity;
    // Grows by at least a half, so that slowly growing frames do not reallocate the buffer each time.
    size_t capacity = bytes > old + old / 2 ? bytes : old + old / 2;
    buffer_release(buffer, call);
    if (call && !call_charge(call, capacity))
        return call_memory_error(call, capacity, error);
    buffer->data = pages_get(capacity, &buffer->capacity);
    if (!buffer->data) {
        if (call)
            call_refund(call, capacity);
        buffer->capacity = 0;
        return call_memory_error(call, capacity, error);
    }
    if (call) // a negative refund: whole pages are counted, even beyond the limit
        call_refund(call, capacity - buffer->capacity);
    return true;
}

void buffer_free(struct buffer *buffer)
{
    pages_free(buffer->data, buffer->capacity);
    *buffer = (struct buffer){0};
}

void buffer_release(struct buffer *buffer, struct call_control *call)
{
    if (call)
        call_refund(call, buffer->capacity);
    buffer_free(buffer);
}
