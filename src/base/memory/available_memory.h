// available_memory.h: the memory that this process may use.
#ifndef AVAILABLE_MEMORY_H
#define AVAILABLE_MEMORY_H

#include <stdint.h>

// lam_memory_available with the system's files below `root` ("" for the system itself, else a folder of a test) and
// without the limits of this process. UINT64_MAX: the files name no limit.
uint64_t memory_of_groups(const char *root);

#endif
