// pthread.h: declarations that wasi-libc lacks. In a module with shared memory (-matomics, threads.c), locks and
// conditions wait, and JavaScript starts the threads in advance (web/threads.js). In any other module there is one
// thread, which never waits.
#ifndef WEB_PTHREAD_H
#define WEB_PTHREAD_H

#include <stddef.h>

typedef int pthread_mutex_t, pthread_cond_t;
typedef struct thread *pthread_t;
#define PTHREAD_MUTEX_INITIALIZER 0

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
// The stacks of threads have one size (threads.c).
typedef int pthread_attr_t;
static inline int pthread_attr_init(pthread_attr_t *attributes) { return *attributes = 0; }
static inline int pthread_attr_setstacksize(pthread_attr_t *attributes, size_t size)
{
    (void)attributes, (void)size;
    return 0;
}
static inline int pthread_attr_destroy(pthread_attr_t *attributes) { return (void)attributes, 0; }
static inline int pthread_mutex_destroy(pthread_mutex_t *mutex) { return (void)mutex, 0; }
static inline int pthread_cond_destroy(pthread_cond_t *changed) { return (void)changed, 0; }

#if defined(__wasm_atomics__)

int pthread_mutex_lock(pthread_mutex_t *mutex);
int pthread_mutex_unlock(pthread_mutex_t *mutex);
int pthread_cond_wait(pthread_cond_t *changed, pthread_mutex_t *mutex);
int pthread_cond_signal(pthread_cond_t *changed);
int pthread_cond_broadcast(pthread_cond_t *changed);
// Returns EAGAIN if no thread is free. There are no attributes.
int pthread_create(pthread_t *thread, const void *attributes, void *task(void *), void *argument);
int pthread_join(pthread_t thread, void **result); // the result is always NULL

#else

static inline int pthread_mutex_lock(pthread_mutex_t *mutex) { return (void)mutex, 0; }
static inline int pthread_mutex_unlock(pthread_mutex_t *mutex) { return (void)mutex, 0; }
// With one thread there is nothing to wait for.
static inline int pthread_cond_wait(pthread_cond_t *changed, pthread_mutex_t *mutex)
{
    return (void)changed, (void)mutex, 0;
}
static inline int pthread_cond_signal(pthread_cond_t *changed) { return (void)changed, 0; }
static inline int pthread_cond_broadcast(pthread_cond_t *changed) { return (void)changed, 0; }
static inline int pthread_create(pthread_t *thread, const void *attributes, void *task(void *), void *argument)
{
    return (void)thread, (void)attributes, (void)task, (void)argument, 6; // EAGAIN
}
static inline int pthread_join(pthread_t thread, void **result) { return (void)thread, (void)result, 0; }

#endif

#endif
