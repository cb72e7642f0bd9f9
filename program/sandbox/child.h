// child.h: starts copies of this process; two pipes connect each copy to this process.
#ifndef CHILD_H
#define CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

// Received bytes.
struct child_bytes {
    char *data; // allocated with malloc
    size_t size, capacity;
};

struct child {
    pid_t pid;    // 0 if there is no process
    int to, from; // the pipes to and from the process; −1 if closed
    struct child_bytes received;
    double stop_ms; // the clock_ms() at which the owner kills the process; 0 if never
    bool stopped;   // whether the owner killed the process at `stop_ms`
};

// A struct child without a process.
#define NO_CHILD ((struct child){.to = -1, .from = -1})

// Starts `work` in a copy of this process. The copy ends when this process ends. `work` reads from `from`, writes to
// `to` and does not return. If this process has other threads, `work` must make only system calls, because the other
// threads may hold locks. Returns false and sets errno on failure.
typedef void child_work(void *user, int from, int to);
bool child_start(struct child *child, child_work *work, void *user);

// Closes the pipe to the process.
void child_send_end(struct child *child);

// Closes the pipes, waits for the end of the process, and returns its status (see waitpid). Does not change `pid`.
int child_wait(struct child *child);

void child_kill(const struct child *child);

// Frees the received bytes of a process that has ended.
void child_free(struct child *child);

// Like child_wait, for a process that is known only by its ID. Does nothing if `pid` is not positive.
int child_wait_pid(pid_t pid);

// child_bytes_reserve makes room for `more` more bytes, and child_bytes_add appends bytes. Both return false if memory
// runs out.
bool child_bytes_reserve(struct child_bytes *bytes, size_t more);
bool child_bytes_add(struct child_bytes *bytes, const void *data, size_t size);

enum child_read {
    CHILD_READ,   // zero or more bytes were read
    CHILD_CLOSED, // the other end is closed, or reading failed
    CHILD_MEMORY, // memory ran out
};

// Reads once, up to `most` bytes.
enum child_read child_read(int from, struct child_bytes *bytes, size_t most);

#endif
