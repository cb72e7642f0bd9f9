// signal.h: extends mingw-w64's header with signal masks. The masks block nothing, because the only signal that Windows
// sends is Ctrl-C.
#ifndef WINDOWS_SIGNAL_H
#define WINDOWS_SIGNAL_H

#include_next <signal.h>

#include <errno.h>

typedef int sigset_t;
#define SIG_SETMASK 2
#define SIGPIPE     13 // signal() rejects these
#define SIGXFSZ     25

static inline int sigfillset(sigset_t *set) { return *set = 0; }
static inline int windows_sigmask(int how, const sigset_t *set, sigset_t *before)
{
    (void)how, (void)set;
    if (before)
        *before = 0;
    return 0;
}

#undef pthread_sigmask
#define pthread_sigmask windows_sigmask

#endif
