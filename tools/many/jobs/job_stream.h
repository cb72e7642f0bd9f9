// job_stream.h: lines of a file or a pipe, each no longer than a limit.
#ifndef JOB_STREAM_H
#define JOB_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct job_stream {
    int file;
    char *data; // the bytes read, from `start` on
    size_t start, end, capacity;
    size_t searched; // from `start` on there is no line end in this many bytes
    size_t limit;    // bytes of a line
    uint64_t line;   // of the last line that was taken, from 1
    bool skips;      // the rest of a line that is too long
    bool ended;      // nothing more can be read
};

// Reads the available bytes, once; waits if there are none. False: errno (ENOMEM: out of memory). An end is none of
// that.
bool job_stream_read(struct job_stream *stream);

// A line that is whole, without its end; at the end of the stream also one without an end. It lives until the next call of any
// of these. TOO_LONG: a line that was longer than the limit; its bytes are not kept. NONE: there is no whole line yet, or no more.
enum job_line { JOB_LINE_NONE, JOB_LINE_WHOLE, JOB_LINE_TOO_LONG };
enum job_line job_stream_next(struct job_stream *stream, const char **text, size_t *size);

#endif
