// lock.h: a mutex.
#ifndef LOCK_H
#define LOCK_H

#include <pthread.h>

typedef pthread_mutex_t lock;
#define LOCK_INITIALIZER PTHREAD_MUTEX_INITIALIZER
static inline void lock_start(lock *l) { pthread_mutex_init(l, NULL); }
static inline void lock_take(lock *l) { pthread_mutex_lock(l); }
static inline void lock_give(lock *l) { pthread_mutex_unlock(l); }
static inline void lock_end(lock *l) { pthread_mutex_destroy(l); }

#endif
