// threads.c: threads of a module with shared memory. Each is a JavaScript worker (web/threads.js) with an instance of
// the module, and with its own stack and thread-local variables in the shared memory. It waits here for tasks of
// pthread_create.
//
// wasi-libc supports only one thread. Of the functions that the pool's threads call, only malloc and related functions
// have state; they run one at a time (the linker's --wrap, web/meson.build). Threads have no files, so code that reads
// files runs on the thread that has them.
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

enum { THREADS_MAX = 64, STACK = 4 << 20 /* as the linker gives the first thread (web/meson.build) */ };

enum state { STARTING, FREE, TAKEN, GIVEN, DONE };

// This struct lies directly above the thread's stack, which grows downwards, and before its thread-local variables.
struct thread {
    int state; // an enum state, accessed atomically
    void *(*task)(void *);
    void *argument;
    alignas(16) char locals[];
};

static struct thread *threads[THREADS_MAX]; // filled before any of them runs
static int thread_count;
static int failed;                    // accessed atomically: a thread has trapped, and will not finish
static _Thread_local bool is_started; // set by web_thread_run: not the first thread

void __wasm_init_tls(void *locals);

struct thread *web_thread_add(void) WEB_EXPORT(web_thread_add);
void web_thread_ready(struct thread *thread) WEB_EXPORT(web_thread_ready);
void web_thread_run(struct thread *thread) WEB_EXPORT(web_thread_run);
void web_thread_failed(void) WEB_EXPORT(web_thread_failed);

// ---- waiting

// Waits until *at is no longer `value`. May return early. The first thread checks once a second whether another thread
// has failed, and then fails too.
static void wait_while(int *at, int value)
{
    const int64_t ns = is_started ? -1 : 1000000000;
    __builtin_wasm_memory_atomic_wait32(at, value, ns);
    if (!is_started && __atomic_load_n(&failed, __ATOMIC_RELAXED))
        __builtin_trap();
}

static void wake(int *at, unsigned count) { __builtin_wasm_memory_atomic_notify(at, count); }

// A mutex is 0 if it is free, 1 if it is locked, or 2 if it is locked and other threads may wait for it (Drepper,
// Futexes Are Tricky, 2011, section 5).
int pthread_mutex_lock(pthread_mutex_t *mutex)
{
    int found = 0;
    if (__atomic_compare_exchange_n(mutex, &found, 1, false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED))
        return 0;
    while (__atomic_exchange_n(mutex, 2, __ATOMIC_ACQUIRE) != 0)
        wait_while(mutex, 2);
    return 0;
}

int pthread_mutex_unlock(pthread_mutex_t *mutex)
{
    if (__atomic_exchange_n(mutex, 0, __ATOMIC_RELEASE) == 2)
        wake(mutex, 1);
    return 0;
}

// A condition counts its signals. If a signal comes before the wait begins, the number has changed, and there is no
// wait.
int pthread_cond_wait(pthread_cond_t *changed, pthread_mutex_t *mutex)
{
    int signals = __atomic_load_n(changed, __ATOMIC_RELAXED);
    pthread_mutex_unlock(mutex);
    wait_while(changed, signals);
    return pthread_mutex_lock(mutex);
}

static int signal_to(pthread_cond_t *changed, unsigned count)
{
    __atomic_add_fetch((unsigned *)changed, 1, __ATOMIC_RELAXED);
    wake(changed, count);
    return 0;
}

int pthread_cond_signal(pthread_cond_t *changed) { return signal_to(changed, 1); }
int pthread_cond_broadcast(pthread_cond_t *changed) { return signal_to(changed, UINT32_MAX); }

// ---- threads

// Returns memory for one more thread. The thread's stack starts at this address. Returns NULL if memory is
// insufficient, or if there are THREADS_MAX threads.
struct thread *web_thread_add(void)
{
    size_t size = sizeof(struct thread) + __builtin_wasm_tls_size();
    char *memory = thread_count < THREADS_MAX ? aligned_alloc(16, (STACK + size + 15) / 16 * 16) : NULL;
    if (!memory)
        return NULL;
    struct thread *thread = (struct thread *)(void *)(memory + STACK);
    *thread = (struct thread){.state = STARTING};
    return threads[thread_count++] = thread;
}

// Called when the thread's worker has an instance and is about to call web_thread_run.
void web_thread_ready(struct thread *thread) { __atomic_store_n(&thread->state, FREE, __ATOMIC_RELEASE); }

// Not inlined, because the thread-local variables do not exist yet in the caller.
__attribute__((noinline)) static void run_tasks(struct thread *thread)
{
    is_started = true;
    for (;;) {
        for (int state; (state = __atomic_load_n(&thread->state, __ATOMIC_ACQUIRE)) != GIVEN;)
            wait_while(&thread->state, state);
        thread->task(thread->argument);
        __atomic_store_n(&thread->state, DONE, __ATOMIC_RELEASE);
        wake(&thread->state, UINT32_MAX);
    }
}

// Called by the thread's own instance after its stack pointer has been set. It does not return.
void web_thread_run(struct thread *thread)
{
    __wasm_init_tls(thread->locals);
    run_tasks(thread);
}

void web_thread_failed(void) { __atomic_store_n(&failed, 1, __ATOMIC_RELAXED); }

int pthread_create(pthread_t *thread, const void *attributes, void *task(void *), void *argument)
{
    (void)attributes;
    for (int i = 0; i < thread_count; i++) {
        int is_free = FREE;
        if (!__atomic_compare_exchange_n(&threads[i]->state, &is_free, TAKEN, false, __ATOMIC_ACQUIRE,
                                         __ATOMIC_RELAXED))
            continue;
        *thread = threads[i];
        threads[i]->task = task;
        threads[i]->argument = argument;
        __atomic_store_n(&threads[i]->state, GIVEN, __ATOMIC_RELEASE);
        wake(&threads[i]->state, UINT32_MAX);
        return 0;
    }
    return EAGAIN;
}

int pthread_join(pthread_t thread, void **result)
{
    for (int state; (state = __atomic_load_n(&thread->state, __ATOMIC_ACQUIRE)) != DONE;)
        wait_while(&thread->state, state);
    if (result)
        *result = NULL;
    __atomic_store_n(&thread->state, FREE, __ATOMIC_RELEASE);
    return 0;
}

int sched_getaffinity(int process, size_t size, cpu_set_t *set)
{
    (void)process, (void)size;
    *set = 1;
    for (int i = 0; i < thread_count; i++)
        *set += __atomic_load_n(&threads[i]->state, __ATOMIC_RELAXED) != STARTING;
    return 0;
}

// ---- memory: wasi-libc's functions, one at a time

static pthread_mutex_t memory_lock = PTHREAD_MUTEX_INITIALIZER;

#define ONE_AT_A_TIME(type, name, parameters, arguments)                                                               \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters                                                                                      \
    {                                                                                                                  \
        pthread_mutex_lock(&memory_lock);                                                                              \
        type result = __real_##name arguments;                                                                         \
        pthread_mutex_unlock(&memory_lock);                                                                            \
        return result;                                                                                                 \
    }

ONE_AT_A_TIME(void *, malloc, (size_t size), (size))
ONE_AT_A_TIME(void *, calloc, (size_t count, size_t size), (count, size))
ONE_AT_A_TIME(void *, realloc, (void *memory, size_t size), (memory, size))
ONE_AT_A_TIME(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
ONE_AT_A_TIME(int, posix_memalign, (void **memory, size_t alignment, size_t size), (memory, alignment, size))

void __real_free(void *memory);
void __wrap_free(void *memory);
void __wrap_free(void *memory)
{
    pthread_mutex_lock(&memory_lock);
    __real_free(memory);
    pthread_mutex_unlock(&memory_lock);
}
