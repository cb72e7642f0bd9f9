// lock.h: a mutex; nothing on WebAssembly, which has one thread.
#ifndef LOCK_H
#define LOCK_H

#if defined(__wasm__)

typedef int lock;
#define LOCK_INITIALIZER 0
static inline void lock_start(lock *l) { *l = 0; }
static inline void lock_take(lock *l) { (void)l; }
static inline void lock_give(lock *l) { (void)l; }
static inline void lock_end(lock *l) { (void)l; }

#else

#include <pthread.h>

typedef pthread_mutex_t lock;
#define LOCK_INITIALIZER PTHREAD_MUTEX_INITIALIZER
static inline void lock_start(lock *l) { pthread_mutex_init(l, NULL); }
static inline void lock_take(lock *l) { pthread_mutex_lock(l); }
static inline void lock_give(lock *l) { pthread_mutex_unlock(l); }
static inline void lock_end(lock *l) { pthread_mutex_destroy(l); }

#endif

#endif
