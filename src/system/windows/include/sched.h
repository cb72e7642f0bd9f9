// sched.h: extends the header of winpthreads with a Linux function that returns the processors that this process may
// use.
#ifndef WINDOWS_SCHED_H
#define WINDOWS_SCHED_H

#include_next <sched.h>

#include <stddef.h>

typedef int cpu_set_t;
#define CPU_COUNT(set) (*(set))

int sched_getaffinity(int process, size_t size, cpu_set_t *set);

#endif
