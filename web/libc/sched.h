// sched.h: wasi-libc's header, and the number of threads that can run at the same time, as on Linux.
#ifndef WEB_SCHED_H
#define WEB_SCHED_H

#include_next <sched.h>

#include <stddef.h>

typedef int cpu_set_t;
#define CPU_COUNT(set) (*(set))

#if defined(__wasm_atomics__)
int sched_getaffinity(int process, size_t size, cpu_set_t *set); // threads.c
#else
static inline int sched_getaffinity(int process, size_t size, cpu_set_t *set)
{
    (void)process, (void)size;
    *set = 1;
    return 0;
}
#endif

#endif
