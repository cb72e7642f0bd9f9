// view_tasks.h: distributes requested pictures to drawing processes. There is at most one process for each processor,
// and one more for the visible page, so that a gallery does not delay this page.
#ifndef VIEW_TASKS_H
#define VIEW_TASKS_H

#include "child.h"
#include "view_draw.h"

enum { VIEW_PROCESSES_MAX = 64 };

// The result of a task.
struct view_result {
    int status;  // the HTTP status
    char *bytes; // the reply with its notes and data, allocated with malloc; may be NULL
    size_t notes_at, notes, data;
};

struct view_task {
    struct view_request request;
    char *words; // allocated with malloc
    // Identifies the page. A newer request of the same kind from this page cancels this task. Allocated with malloc;
    // NULL for a thumbnail.
    char *client;
    void *user; // NULL if nobody waits for the result any more
    bool running;
    bool superseded; // replaced by a newer task
    struct view_task *next;
};

// A drawing process (view_draw.h), which handles one request at a time.
struct view_process {
    struct child child;
    char *model;    // the model of the last request, or NULL
    void *task;     // the task of the current request; NULL if the process is idle
    bool cancelled; // the current request is being cancelled
};

struct view_tasks {
    const struct view_files *files;
    const struct options *options;
    void (*done)(void *user, struct view_result *result); // takes ownership of the bytes
    struct view_task *first;
    struct view_process processes[VIEW_PROCESSES_MAX];
    int count;            // the maximum number of processes
    double time_limit_ms; // for a request
};

void view_tasks_start(struct view_tasks *tasks, const struct view_files *files, const struct options *options,
                      void (*done)(void *user, struct view_result *result));

// Adds a task and copies `words` and `client`. When the task ends, `done` is called with `user`, but never during this
// call. Returns NULL if memory runs out.
struct view_task *view_tasks_add(struct view_tasks *tasks, const struct view_request *request, const char *words,
                                 const char *client, void *user);

// Discards a task whose result is no longer needed.
void view_tasks_drop(struct view_tasks *tasks, struct view_task *task);

// Assigns waiting tasks to processes and reads results. Call this regularly, and whenever the file handle of a process
// is readable.
void view_tasks_step(struct view_tasks *tasks);

// Ends all processes, and finishes all tasks with status 503.
void view_tasks_end(struct view_tasks *tasks);

#endif
