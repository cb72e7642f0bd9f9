// pthread.h: the names that one thread needs, which waits for nobody: wasi-libc has none.
#ifndef WEB_PTHREAD_H
#define WEB_PTHREAD_H

#include <stddef.h>

typedef int pthread_mutex_t, pthread_cond_t;

static inline int pthread_mutex_init(pthread_mutex_t *mutex, const void *attributes)
{
    (void)attributes;
    return *mutex = 0;
}
static inline int pthread_cond_init(pthread_cond_t *changed, const void *attributes)
{
    (void)attributes;
    return *changed = 0;
}
static inline int pthread_mutex_destroy(pthread_mutex_t *mutex) { return (void)mutex, 0; }
static inline int pthread_mutex_lock(pthread_mutex_t *mutex) { return (void)mutex, 0; }
static inline int pthread_mutex_unlock(pthread_mutex_t *mutex) { return (void)mutex, 0; }
static inline int pthread_cond_destroy(pthread_cond_t *changed) { return (void)changed, 0; }
static inline int pthread_cond_broadcast(pthread_cond_t *changed) { return (void)changed, 0; }
// What one thread waits for is there already: nobody else could bring it.
static inline int pthread_cond_wait(pthread_cond_t *changed, pthread_mutex_t *mutex)
{
    return (void)changed, (void)mutex, 0;
}

#endif
