// batch_process.c: runs a function in a separate process.
#include "batch_process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file_io.h"
#include "interrupt.h"
#include "progress.h"

enum { PROCESSES_MAX = 1024 };

bool batch_answer_add(struct batch_answer *answer, const void *data, size_t size)
{
    if (answer->capacity - answer->size < size) {
        size_t capacity =
            2 * answer->capacity > answer->size + size ? 2 * answer->capacity : answer->size + size + 4096;
        void *more = realloc(answer->data, capacity);
        if (!more)
            return false;
        answer->data = more;
        answer->capacity = capacity;
    }
    if (size) // memcpy must not get NULL even for 0 bytes
        memcpy(answer->data + answer->size, data, size);
    answer->size += size;
    return true;
}

bool batch_process_start(struct batch_process *process, batch_work *work, void *user)
{
    int pipes[2];
    *process = (struct batch_process){.from = -1};
    if (pipe2(pipes, O_CLOEXEC) != 0)
        return false;
    pid_t parent = getpid();
    process->pid = fork();
    if (process->pid == 0) {
        interrupt_with_parent(parent);
        setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
        close(pipes[0]);
        struct batch_answer answer = {0};
        work(user, &answer);
        _exit(!write_all(pipes[1], answer.data, answer.size));
    }
    int reason = errno;
    close(pipes[1]);
    process->from = pipes[0];
    if (process->pid > 0)
        return true;
    close(pipes[0]);
    *process = (struct batch_process){.from = -1};
    errno = reason;
    return false;
}

// Reads the available bytes. Returns false at the end of the data.
static bool receive(struct batch_process *process)
{
    char chunk[16 << 10];
    ssize_t got = read(process->from, chunk, sizeof chunk);
    if (got < 0)
        return errno == EINTR || errno == EAGAIN;
    return got > 0 && batch_answer_add(&process->answer, chunk, (size_t)got);
}

int batch_process_wait(struct batch_process *list, int count, int also, int wait_ms, int *status)
{
    struct pollfd wait[PROCESSES_MAX + 1];
    count = count < PROCESSES_MAX ? count : PROCESSES_MAX;
    double now = clock_ms();
    for (int i = 0; i < count; i++) {
        wait[i] = (struct pollfd){.fd = list[i].pid ? list[i].from : -1, .events = POLLIN};
        if (list[i].pid && list[i].stop_ms > 0 && now > list[i].stop_ms && !list[i].stopped) {
            list[i].stopped = true;
            batch_process_kill(&list[i]);
        }
    }
    wait[count] = (struct pollfd){.fd = also, .events = POLLIN};
    if (poll(wait, (nfds_t)count + 1, wait_ms) <= 0)
        return -1;
    for (int i = 0; i < count; i++) {
        if (wait[i].fd < 0 || !wait[i].revents || receive(&list[i]))
            continue;
        close(list[i].from);
        list[i].from = -1;
        while (waitpid(list[i].pid, status, 0) < 0 && errno == EINTR)
            continue;
        return i;
    }
    return -1;
}

void batch_process_kill(struct batch_process *process)
{
    if (process->pid > 0)
        kill(process->pid, SIGKILL);
}

void batch_process_free(struct batch_process *process)
{
    if (process->from >= 0)
        close(process->from);
    free(process->answer.data);
    *process = (struct batch_process){.from = -1};
}
