// view_process.h: controls a drawing process (view_draw.h) from the server. A drawing process handles one request at a
// time.
#ifndef VIEW_PROCESS_H
#define VIEW_PROCESS_H

#include "child.h"
#include "view_draw.h"

struct view_process {
    struct child child;
    char *model;                 // the model of the last request, or NULL
    void *task;                  // the task of the current request; NULL if the process is idle
    bool cancelled;              // the current request is being cancelled
    double stop_ms;              // the clock_ms() at which the process is killed; 0 if never
    struct child_bytes received; // the received part of the answer
};

// Starts a process. The calling process must have no other threads. Returns false and sets errno on failure.
bool view_process_start(struct view_process *process, const struct view_files *files, const struct options *options);

// Sends a request and its words. Returns false and sets errno on failure.
bool view_process_ask(struct view_process *process, const struct view_request *request, const char *words, void *task);

// Requests the cancellation of the current request. A process that does not react is killed after two seconds.
void view_process_cancel(struct view_process *process);

// Reads the available bytes. If the answer is complete, sets *reply and returns 1. Returns 0 if the answer is
// incomplete, and −1 if the process has ended or sent an invalid answer.
int view_process_receive(struct view_process *process, struct view_reply *reply);

// Returns a complete answer: the header, the notes and the data. The caller owns the memory, which is allocated with
// malloc. The process can then handle the next request.
char *view_process_take(struct view_process *process);

// Kills the process and waits for its end.
void view_process_end(struct view_process *process);

#endif
