// view_tasks.h: requested pictures, and the processes that draw them: at most one for each processor, and one more for
// the page in front, so that a gallery does not delay it.
#ifndef VIEW_TASKS_H
#define VIEW_TASKS_H

#include "view_process.h"

enum { VIEW_PROCESSES_MAX = 64 };

// The state of a task.
struct view_result {
    int status;  // of HTTP
    char *bytes; // the reply, its notes and its data, from malloc; NULL: there are none
    size_t notes_at, notes, data;
};

struct view_task {
    struct view_request request;
    char *words;  // from malloc
    char *client; // the page that asks, from malloc: a newer picture ends its older one; NULL: a thumbnail
    void *user;   // NULL: nobody waits for it any more
    bool running;
    bool superseded; // a newer one has taken its place
    struct view_task *next;
};

struct view_tasks {
    const struct view_files *files;
    const struct options *options;
    void (*done)(void *user, struct view_result *result); // takes over the bytes
    struct view_task *first;
    struct view_process processes[VIEW_PROCESSES_MAX];
    int count;            // of processes that may run
    double time_limit_ms; // of a request
};

void view_tasks_start(struct view_tasks *tasks, const struct view_files *files, const struct options *options,
                      void (*done)(void *user, struct view_result *result));

// Adds a task; `words` and `client` are copied. Its end calls `done` with `user`, never from within this call. Returns
// NULL if memory runs out.
struct view_task *view_tasks_add(struct view_tasks *tasks, const struct view_request *request, const char *words,
                                 const char *client, void *user);

// Nobody waits for it any more.
void view_tasks_drop(struct view_tasks *tasks, struct view_task *task);

// Gives waiting tasks to processes, and reads their results. Call it when one of their files can be read, and now and
// then.
void view_tasks_step(struct view_tasks *tasks);

// Ends all processes, and all tasks, with 503.
void view_tasks_end(struct view_tasks *tasks);

#endif
