// sys/mman.h: allocates anonymous memory.
#ifndef WINDOWS_MMAN_H
#define WINDOWS_MMAN_H

#include <stdlib.h>

#define PROT_READ     1
#define PROT_WRITE    2
#define MAP_SHARED    1
#define MAP_ANONYMOUS 32
#define MAP_FAILED    ((void *)-1)

// Allocates zeroed memory of this process; no other process can share it.
static inline void *mmap(void *at, size_t size, int rights, int kind, int file, long long offset)
{
    (void)at, (void)rights, (void)kind, (void)file, (void)offset;
    void *memory = calloc(1, size);
    return memory ? memory : MAP_FAILED;
}

static inline int munmap(void *memory, size_t size)
{
    (void)size;
    free(memory);
    return 0;
}

#endif
