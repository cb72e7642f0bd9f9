// memory.c: implements pages.h and available_memory.h for Windows: large blocks of memory, and the memory available to
// this process.
#include "available_memory.h"
#include "pages.h"

#include <lambent/base.h>

#include <stdlib.h>
#include <windows.h>

enum { PAGE = 4096 };

static size_t whole_pages(size_t bytes) { return bytes ? (bytes + PAGE - 1) / PAGE * PAGE : PAGE; }

// Windows commits memory when it is requested, and provides physical memory on first access.
void *pages_get(size_t bytes, size_t *held)
{
    if (bytes > SIZE_MAX / 2)
        return NULL;
    *held = whole_pages(bytes);
    return VirtualAlloc(NULL, *held, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
}

void *pages_get_sparse(size_t bytes, size_t *held) { return pages_get(bytes, held); }

void pages_free(void *pages, size_t held)
{
    (void)held;
    if (pages)
        VirtualFree(pages, 0, MEM_RELEASE);
}

void *pages_malloc(size_t bytes) { return malloc(bytes); }

void pages_prepare(void *at, size_t bytes)
{
    (void)at;
    (void)bytes;
}

void pages_trim(void *pages, size_t *held, size_t bytes)
{
    size_t kept = whole_pages(bytes);
    if (kept >= *held)
        return;
    VirtualFree((char *)pages + kept, *held - kept, MEM_DECOMMIT);
    *held = kept;
}

size_t pages_of_machine(void)
{
    MEMORYSTATUSEX memory = {.dwLength = sizeof memory};
    return GlobalMemoryStatusEx(&memory) ? memory.ullTotalPhys : SIZE_MAX;
}

uint64_t memory_of_groups(const char *root)
{
    (void)root;
    return UINT64_MAX;
}

uint64_t processors_of_groups(const char *root) { return memory_of_groups(root); }

// A Windows job object limits the memory of a process, like a Linux control group.
uint64_t lam_memory_available(void)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits;
    size_t machine = pages_of_machine();
    uint64_t bytes = machine == SIZE_MAX ? UINT64_MAX : machine;
    if (!QueryInformationJobObject(NULL, JobObjectExtendedLimitInformation, &limits, sizeof limits, NULL))
        return bytes;
    DWORD flags = limits.BasicLimitInformation.LimitFlags;
    if (flags & JOB_OBJECT_LIMIT_PROCESS_MEMORY && limits.ProcessMemoryLimit < bytes)
        bytes = limits.ProcessMemoryLimit;
    if (flags & JOB_OBJECT_LIMIT_JOB_MEMORY && limits.JobMemoryLimit < bytes)
        bytes = limits.JobMemoryLimit;
    return bytes;
}
