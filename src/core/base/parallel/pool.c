// pool.c: a thread pool for parallel loops.
#include "pool.h"

#include "available_memory.h"
#include "call_control.h"
#include "float_state.h"

#include <lambent/base.h>

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>

enum {
    THREADS_MAX = 1024,
    WORKER_STACK = 1 << 20, // stack size in bytes; drawing uses less than 128 kB. The system's default would depend on
                            // `ulimit -s`.
    SPIN_NS = 50000,        // a thread waits this long before it sleeps: about the time for waking a thread
};

struct pool {
    int threads; // number of threads, including the caller
    pthread_mutex_t lock;
    pthread_cond_t work, done;
    unsigned round;    // incremented by each pool_run and by pool_free
    unsigned finished; // the last round that all workers have finished
    int busy;          // workers that have not yet finished the round
    bool closing;
    bool alone; // only the caller runs tasks
    bool spins; // whether waiting threads spin before they sleep

    // The work of the current round.
    pool_task *task;
    void *user;
    size_t count;
    size_t next; // accessed atomically

    struct worker {
        struct pool *pool;
        int number;
        pthread_t thread;
    } workers[];
};

// Tells the processor that this thread waits in a loop, so that the core's other thread runs faster.
static inline void pause_briefly(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

static void take_work(struct pool *pool, int thread)
{
    for (;;) {
        size_t index = __atomic_fetch_add(&pool->next, 1, __ATOMIC_RELAXED);
        if (index >= pool->count)
            return;
        pool->task(pool->user, index, thread);
    }
}

// Waits a short time for another thread to change *round. The other thread holds the lock when it changes *round.
static void spin_while(const struct pool *pool, const unsigned *round, unsigned value)
{
    const uint64_t start = now_ns();
    while (pool->spins && __atomic_load_n(round, __ATOMIC_RELAXED) == value && now_ns() - start < SPIN_NS)
        pause_briefly();
}

static void *worker_main(void *argument)
{
    struct worker *worker = argument;
    struct pool *pool = worker->pool;
    float_state_enter();
    unsigned seen = 0;
    for (;;) {
        if (seen > 0) // the first round may begin long after the start
            spin_while(pool, &pool->round, seen);
        pthread_mutex_lock(&pool->lock);
        while (pool->round == seen)
            pthread_cond_wait(&pool->work, &pool->lock);
        if (pool->closing)
            break;
        seen = pool->round;
        pthread_mutex_unlock(&pool->lock);
        take_work(pool, worker->number);
        pthread_mutex_lock(&pool->lock);
        if (--pool->busy == 0) {
            __atomic_store_n(&pool->finished, seen, __ATOMIC_RELAXED);
            pthread_cond_signal(&pool->done);
        }
        pthread_mutex_unlock(&pool->lock);
    }
    pthread_mutex_unlock(&pool->lock);
    return NULL;
}

int lam_processors_available(void)
{
    static uint64_t kept; // 0 before the first call; a sandbox makes the system's files inaccessible
    cpu_set_t set;
    uint64_t quota = __atomic_load_n(&kept, __ATOMIC_RELAXED);
    if (!quota) {
        quota = processors_of_groups("");
        quota = quota ? quota : 1;
        __atomic_store_n(&kept, quota, __ATOMIC_RELAXED);
    }
    int count = sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0 ? CPU_COUNT(&set) : 1;
    return quota < (uint64_t)count ? (int)quota : count;
}

struct pool *pool_make(int threads)
{
    if (threads <= 0)
        threads = lam_processors_available();
    if (threads > THREADS_MAX)
        threads = THREADS_MAX;
    struct pool *pool = calloc(1, sizeof *pool + (size_t)threads * sizeof pool->workers[0]);
    if (!pool)
        return NULL;
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->work, NULL);
    pthread_cond_init(&pool->done, NULL);
    pool->threads = 1;
    pool->spins = threads <= lam_processors_available();
    // Workers block all signals, so that the program's own threads handle them.
    sigset_t all, before;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, WORKER_STACK);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    for (int i = 1; i < threads; i++) {
        struct worker *worker = &pool->workers[i];
        worker->pool = pool;
        worker->number = i;
        if (pthread_create(&worker->thread, &attributes, worker_main, worker) != 0)
            break;
        pool->threads++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    return pool;
}

void pool_free(struct pool *pool)
{
    if (!pool)
        return;
    pthread_mutex_lock(&pool->lock);
    pool->closing = true;
    __atomic_store_n(&pool->round, pool->round + 1, __ATOMIC_RELAXED);
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->lock);
    for (int i = 1; i < pool->threads; i++)
        pthread_join(pool->workers[i].thread, NULL);
    pthread_cond_destroy(&pool->done);
    pthread_cond_destroy(&pool->work);
    pthread_mutex_destroy(&pool->lock);
    free(pool);
}

int pool_threads(const struct pool *pool) { return pool && !pool->alone ? pool->threads : 1; }

void pool_set_alone(struct pool *pool, bool alone)
{
    if (pool)
        pool->alone = alone;
}

void pool_run(struct pool *pool, size_t count, pool_task *task, void *user)
{
    if (pool_threads(pool) == 1 || count <= 1) {
        uint64_t state = float_state_enter();
        for (size_t i = 0; i < count; i++)
            task(user, i, 0);
        float_state_leave(state);
        return;
    }
    pthread_mutex_lock(&pool->lock);
    pool->task = task;
    pool->user = user;
    pool->count = count;
    __atomic_store_n(&pool->next, 0, __ATOMIC_RELAXED);
    pool->busy = pool->threads - 1;
    const unsigned before = pool->round;
    __atomic_store_n(&pool->round, before + 1, __ATOMIC_RELAXED);
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->lock);

    uint64_t state = float_state_enter();
    take_work(pool, 0);
    float_state_leave(state);

    spin_while(pool, &pool->finished, before);
    pthread_mutex_lock(&pool->lock);
    while (pool->busy)
        pthread_cond_wait(&pool->done, &pool->lock);
    pthread_mutex_unlock(&pool->lock);
}
