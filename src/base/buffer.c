// buffer.c: memory that a device keeps from frame to frame and only ever grows.
#include "buffer.h"

#include "pages.h"

#include <stdint.h>

bool buffer_reserve(struct buffer *buffer, size_t bytes, struct call_control *call, lam_error *error)
{
    if (bytes <= buffer->room)
        return true;
    size_t old = buffer->room;
    // Grow by half again at least, so that slowly growing frames do not allocate each time.
    size_t room = bytes > old + old / 2 ? bytes : old + old / 2;
    buffer_free(buffer);
    if (call)
        call_refund(call, old);
    if (call && !call_charge(call, room))
        return call_memory_error(call, room, error);
    buffer->data = pages_get(room, &buffer->room);
    if (!buffer->data) {
        if (call)
            call_refund(call, room);
        buffer->room = 0;
        return call_memory_error(call, room, error);
    }
    if (call)
        call_charge(call, buffer->room - room);
    return true;
}

void buffer_free(struct buffer *buffer)
{
    pages_free(buffer->data, buffer->room);
    *buffer = (struct buffer){0};
}
