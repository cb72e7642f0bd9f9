// child.c: starts child processes, receives their output, and waits until they end.
#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "interrupt.h"

static void close_pair(const int pair[2])
{
    for (int i = 0; i < 2; i++)
        if (pair[i] >= 0)
            close(pair[i]);
}

bool child_start(struct child *child, child_work *work, void *user)
{
    int in[2] = {-1, -1}, out[2] = {-1, -1};
    bool piped = pipe2(in, O_CLOEXEC) == 0 && pipe2(out, O_CLOEXEC) == 0;
    pid_t parent = getpid(), pid = piped ? fork() : -1;
    if (pid == 0) {
        interrupt_with_parent(parent);
        close(in[1]);
        close(out[0]);
        work(user, in[0], out[1]);
        _exit(1);
    }
    *child = NO_CHILD;
    if (pid < 0) {
        int reason = errno;
        close_pair(in);
        close_pair(out);
        errno = reason;
        return false;
    }
    close(in[0]);
    close(out[1]);
    *child = (struct child){.pid = pid, .to = in[1], .from = out[0]};
    return true;
}

void child_send_end(struct child *child)
{
    if (child->to >= 0)
        close(child->to);
    child->to = -1;
}

int child_wait_pid(pid_t pid)
{
    int status = 0;
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    return status;
}

int child_wait(struct child *child)
{
    close_pair((int[]){child->to, child->from});
    child->to = child->from = -1;
    return child_wait_pid(child->pid);
}

void child_kill(const struct child *child)
{
    if (child->pid > 0)
        kill(child->pid, SIGKILL);
}

void child_free(struct child *child)
{
    free(child->received.data);
    *child = NO_CHILD;
}

bool child_bytes_reserve(struct child_bytes *b, size_t more)
{
    if (b->capacity - b->size >= more)
        return true;
    size_t capacity = 2 * b->capacity > b->size + more ? 2 * b->capacity : b->size + more;
    void *data = realloc(b->data, capacity);
    if (!data)
        return false;
    b->data = data;
    b->capacity = capacity;
    return true;
}

bool child_bytes_add(struct child_bytes *b, const void *data, size_t size)
{
    if (!child_bytes_reserve(b, size))
        return false;
    if (size) // memcpy must not get NULL even for 0 bytes
        memcpy(b->data + b->size, data, size);
    b->size += size;
    return true;
}

enum child_read child_read(int from, struct child_bytes *b, size_t most)
{
    if (!child_bytes_reserve(b, most))
        return CHILD_MEMORY;
    ssize_t got = read(from, b->data + b->size, most);
    if (got > 0)
        b->size += (size_t)got;
    return got > 0 || (got < 0 && (errno == EINTR || errno == EAGAIN)) ? CHILD_READ : CHILD_CLOSED;
}
