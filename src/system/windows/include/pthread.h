// pthread.h: extends the header of winpthreads. The timed waits of winpthreads compare the deadline with the time of
// day. These functions compare the deadline with CLOCK_MONOTONIC.
#ifndef WINDOWS_PTHREAD_H
#define WINDOWS_PTHREAD_H

#include_next <pthread.h>
#include <signal.h>

int windows_cond_timedwait(pthread_cond_t *changed, pthread_mutex_t *mutex, const struct timespec *until);
#define pthread_cond_timedwait windows_cond_timedwait

#undef pthread_sigmask
#define pthread_sigmask windows_sigmask

#endif
