// batch_process.c: runs a function in a separate process.
#include "batch_process.h"

#include <poll.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "file_io.h"
#include "progress.h"

enum { PROCESSES_MAX = 1024, READ_BYTES = 16 << 10 };

struct start {
    batch_work *work;
    void *user;
};

static void run(void *user, int from, int to)
{
    const struct start *start = user;
    struct child_bytes answer = {0};
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    close(from);
    start->work(start->user, &answer);
    _exit(!write_all(to, answer.data, answer.size));
}

bool batch_process_start(struct batch_process *process, batch_work *work, void *user)
{
    *process = (struct batch_process){.child = NO_CHILD};
    if (!child_start(&process->child, run, &(struct start){work, user}))
        return false;
    child_send_end(&process->child);
    return true;
}

int batch_process_wait(struct batch_process *list, int count, int also, int wait_ms, int *status)
{
    struct pollfd wait[PROCESSES_MAX + 1];
    count = count < PROCESSES_MAX ? count : PROCESSES_MAX;
    double now = clock_ms();
    for (int i = 0; i < count; i++) {
        wait[i] = (struct pollfd){.fd = list[i].child.pid ? list[i].child.from : -1, .events = POLLIN};
        if (list[i].child.pid && list[i].stop_ms > 0 && now > list[i].stop_ms && !list[i].stopped) {
            list[i].stopped = true;
            child_kill(&list[i].child);
        }
    }
    wait[count] = (struct pollfd){.fd = also, .events = POLLIN};
    if (poll(wait, (nfds_t)count + 1, wait_ms) <= 0)
        return -1;
    for (int i = 0; i < count; i++) {
        if (wait[i].fd < 0 || !wait[i].revents ||
            child_read(list[i].child.from, &list[i].answer, READ_BYTES) == CHILD_READ)
            continue;
        *status = child_wait(&list[i].child);
        return i;
    }
    return -1;
}

void batch_process_free(struct batch_process *process)
{
    free(process->answer.data);
    *process = (struct batch_process){.child = NO_CHILD};
}
