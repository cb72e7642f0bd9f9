// poll.h: waits for a pipe. Any other file is reported as ready.
#ifndef WINDOWS_POLL_H
#define WINDOWS_POLL_H

#define POLLIN  1
#define POLLOUT 4
#define POLLERR 8
#define POLLHUP 16

typedef unsigned nfds_t;
struct pollfd {
    int fd; // negative: ignored
    short events, revents;
};

int poll(struct pollfd *files, nfds_t count, int wait_ms);

#endif
