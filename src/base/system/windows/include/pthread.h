// pthread.h: extends the header of winpthreads. The timed waits of winpthreads use only the time of day; here the
// deadline is a time of CLOCK_MONOTONIC.
#ifndef WINDOWS_PTHREAD_H
#define WINDOWS_PTHREAD_H

#include_next <pthread.h>
#include <signal.h>

int windows_cond_timedwait(pthread_cond_t *changed, pthread_mutex_t *mutex, const struct timespec *until);
#define pthread_cond_timedwait windows_cond_timedwait

#undef pthread_sigmask
#define pthread_sigmask windows_sigmask

#endif
