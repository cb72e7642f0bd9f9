// available_memory.h: the memory that this process may use.
#ifndef AVAILABLE_MEMORY_H
#define AVAILABLE_MEMORY_H

#include <stdint.h>

// Works like lam_memory_available, with the system files below `root` ("": the real ones; else a folder of a test) and
// without this process's resource limits. UINT64_MAX: the files set no limit.
uint64_t memory_of_groups(const char *root);

#endif
