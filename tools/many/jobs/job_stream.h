// job_stream.h: reads lines from a file or a pipe, each no longer than a limit.
#ifndef JOB_STREAM_H
#define JOB_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct job_stream {
    int file;
    char *data; // unconsumed bytes, from `start` on
    size_t start, end, capacity;
    size_t searched; // the first bytes after `start`, in which no line end was found
    size_t limit;    // bytes per line
    uint64_t line;   // number of the last line taken, from 1
    bool skips;      // the rest of a line that is too long is being skipped
    bool ended;      // the end of the stream was reached
};

// Reads the available bytes once; waits if there are none. Returns false and sets errno on failure (ENOMEM: out of
// memory). The end of the stream is not a failure.
bool job_stream_read(struct job_stream *stream);

// Gets a complete line without its line end. At the end of the stream, also gets an incomplete line. The text is valid
// until the next call. TOO_LONG means that the line exceeded the limit; its bytes are discarded. NONE means there is no
// complete line yet, or the stream has ended.
enum job_line { JOB_LINE_NONE, JOB_LINE_WHOLE, JOB_LINE_TOO_LONG };
enum job_line job_stream_next(struct job_stream *stream, const char **text, size_t *size);

#endif
