// view_process.h: a drawing process (view_draw.h), as the server sees it: one request at a time.
#ifndef VIEW_PROCESS_H
#define VIEW_PROCESS_H

#include <sys/types.h>

#include "view_draw.h"

struct view_process {
    pid_t pid; // 0: none
    int to, from;
    char *model;    // of its last request; NULL: none
    void *task;     // whose request it works on; NULL: none, it waits
    bool cancelled; // it has been asked to end that
    double stop_ms; // clock_ms() at which it is killed; 0: never
    char *received; // of the answer
    size_t size, capacity;
};

// Starts one. This process must have no other thread. False: errno.
bool view_process_start(struct view_process *process, const struct view_files *files, const struct options *options);

// Sends a request and its words. Returns false if it does not take them; errno.
bool view_process_ask(struct view_process *process, const struct view_request *request, const char *words, void *task);

// Asks it to end its request; one that does not is killed after a while.
void view_process_cancel(struct view_process *process);

// Reads the bytes that have arrived. 1: the answer is whole, *reply with `received` after it; 0: not yet, or −1 if the
// process has ended, or sends nonsense.
int view_process_receive(struct view_process *process, struct view_reply *reply);

// Returns the notes and the data of a whole answer: `received` from malloc, which the caller takes over. It may take
// the next request then.
char *view_process_take(struct view_process *process);

// Kills it, and waits for its end.
void view_process_end(struct view_process *process);

#endif
