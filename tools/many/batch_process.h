// batch_process.h: runs a function in a separate process, whose crash cannot affect other processes.
#ifndef BATCH_PROCESS_H
#define BATCH_PROCESS_H

#include "child.h"

struct batch_process {
    struct child child;
    struct child_bytes answer;
    double stop_ms; // the clock_ms() at which the process will be killed, or 0
    bool stopped;   // whether the process was killed at `stop_ms`
    pid_t writer;   // 0, or the writer for this process; the writer ends after the process
};

// Starts `work` in a copy of this process. This process must have no other thread. The copy sends back the bytes that
// `work` adds to the answer. Returns false and sets errno on failure.
typedef void batch_work(void *user, struct child_bytes *answer);
bool batch_process_start(struct batch_process *process, batch_work *work, void *user);

// Waits at most `wait_ms` until a process sends data, a process ends, or the file `also` (−1 if there is none) is
// readable. Returns the index of a process that has ended, with the status from waitpid, or −1 if no process has ended.
int batch_process_wait(struct batch_process *list, int count, int also, int wait_ms, int *status);

void batch_process_free(struct batch_process *process);

#endif
