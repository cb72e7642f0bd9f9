// job_stream.c: reads lines from a file or a pipe.
#include "batch_job.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CHUNK = 64 << 10, KEPT = 1 << 20 };

// Makes space for more bytes: removes consumed bytes, frees a large buffer that is empty, and enlarges a full buffer.
static bool make_room(struct job_stream *s)
{
    if (s->start) {
        memmove(s->data, s->data + s->start, s->end - s->start);
        s->end -= s->start;
        s->start = 0;
    }
    size_t wanted = s->end + CHUNK, capacity = s->capacity;
    if (!s->end && capacity > KEPT) {
        free(s->data);
        s->data = NULL;
        s->capacity = capacity = 0;
    }
    while (capacity < wanted)
        capacity = capacity ? 2 * capacity : CHUNK;
    char *data = capacity > s->capacity ? realloc(s->data, capacity) : s->data;
    if (!data)
        return false;
    s->data = data;
    s->capacity = capacity;
    return true;
}

bool job_stream_read(struct job_stream *s)
{
    if (!make_room(s)) {
        errno = ENOMEM;
        return false;
    }
    ssize_t got = read(s->file, s->data + s->end, CHUNK);
    if (got < 0)
        return errno == EINTR || errno == EAGAIN;
    s->ended = got == 0;
    s->end += (size_t)got;
    return true;
}

// Removes `size` bytes, and a line end of `after` bytes, from the stream.
static void take(struct job_stream *s, size_t size, size_t after)
{
    s->start += size + after;
    s->searched = 0;
    s->line++;
}

enum job_line job_stream_next(struct job_stream *s, const char **text, size_t *size)
{
    size_t there = s->end - s->start;
    const char *from = s->data ? s->data + s->start : "",
               *end = there > s->searched ? memchr(from + s->searched, '\n', there - s->searched) : NULL;
    size_t length = end ? (size_t)(end - from) : there;
    *text = from;
    *size = length;
    s->searched = length;
    if (s->skips) {
        s->skips = !end && !s->ended;
        s->start += length + (end != NULL);
        s->searched = 0;
        return end || s->ended ? JOB_LINE_TOO_LONG : JOB_LINE_NONE;
    }
    if (length > s->limit) {
        s->skips = !end && !s->ended;
        take(s, length, end != NULL);
        return s->skips ? JOB_LINE_NONE : JOB_LINE_TOO_LONG;
    }
    if (!end && !(s->ended && length))
        return JOB_LINE_NONE;
    take(s, length, end != NULL);
    return JOB_LINE_WHOLE;
}
