// sched.h: winpthreads', and how many processors this process may use, as Linux says it.
#ifndef WINDOWS_SCHED_H
#define WINDOWS_SCHED_H

#include_next <sched.h>

#include <stddef.h>

typedef int cpu_set_t;
#define CPU_COUNT(set) (*(set))

int sched_getaffinity(int process, size_t size, cpu_set_t *set);

#endif
