// pthread.h: winpthreads', whose waits with a limit know the time of day alone: here the limit is one of CLOCK_MONOTONIC.
#ifndef WINDOWS_PTHREAD_H
#define WINDOWS_PTHREAD_H

#include_next <pthread.h>
#include <signal.h>

int windows_cond_timedwait(pthread_cond_t *changed, pthread_mutex_t *mutex, const struct timespec *until);
#define pthread_cond_timedwait windows_cond_timedwait

#undef pthread_sigmask
#define pthread_sigmask windows_sigmask

#endif
