// batch_process.h: runs a function in a separate process, whose end cannot affect other processes.
#ifndef BATCH_PROCESS_H
#define BATCH_PROCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

// Bytes that a process sends back.
struct batch_answer {
    char *data; // from malloc
    size_t size, capacity;
};

struct batch_process {
    pid_t pid; // 0: none
    int from;
    struct batch_answer answer;
    double stop_ms; // clock_ms() at which it is killed; 0: never
    bool stopped;   // it was killed for that reason
    pid_t writer;   // writes its files, and ends after it; 0: none
};

// Starts `work` in a copy of this process, which must have no other thread. The result of `work` is sent back. False:
// errno.
typedef void batch_work(void *user, struct batch_answer *answer);
bool batch_process_start(struct batch_process *process, batch_work *work, void *user);

// Waits up to `wait_ms` for any of them to say or to end something, or for bytes to be read from the file `also` (−1:
// none). Returns the index of one that has ended, with its status of waitpid, or −1 if none has.
int batch_process_wait(struct batch_process *list, int count, int also, int wait_ms, int *status);

void batch_process_kill(struct batch_process *process);
void batch_process_free(struct batch_process *process);

// Appends bytes; false: out of memory.
bool batch_answer_add(struct batch_answer *answer, const void *data, size_t size);

#endif
