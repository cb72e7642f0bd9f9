// signal.h: wasi-libc's emulation, and signal masks without effect, because a module receives no signals.
#ifndef WEB_SIGNAL_H
#define WEB_SIGNAL_H

#include_next <signal.h>

#include <__typedef_sigset_t.h>

#define SIG_SETMASK 2

static inline int sigfillset(sigset_t *set) { return *set = 0; }
static inline int pthread_sigmask(int how, const sigset_t *set, sigset_t *before)
{
    (void)how, (void)set;
    if (before)
        *before = 0;
    return 0;
}

#endif
