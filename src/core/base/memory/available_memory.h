// available_memory.h: the memory and the processors that this process may use.
#ifndef AVAILABLE_MEMORY_H
#define AVAILABLE_MEMORY_H

#include <stdint.h>

// Works like lam_memory_available, but ignores this process's resource limits and reads the system files below the
// folder `root`. `root` is "", except in tests. Returns UINT64_MAX if the files set no limit.
uint64_t memory_of_groups(const char *root);

// Returns the number of processors whose time the quotas of the control groups (v2) allow, rounded up. Returns
// UINT64_MAX if they set no quota.
uint64_t processors_of_groups(const char *root);

#endif
