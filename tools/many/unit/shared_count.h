// shared_count.h: a counter shared by processes, which limits the number of pictures on a page.
#ifndef SHARED_COUNT_H
#define SHARED_COUNT_H

#include <stdatomic.h>
#include <stdbool.h>
#include <sys/mman.h>

// Allocates a counter with the value 0 in memory that is shared with child processes. Returns NULL if memory runs out.
static inline atomic_int *shared_count_make(void)
{
    void *memory = mmap(NULL, sizeof(atomic_int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? NULL : memory;
}

static inline void shared_count_free(atomic_int *count)
{
    if (count)
        munmap(count, sizeof *count);
}

// Increments the counter. Returns false if the counter had already reached `most`.
static inline bool shared_count_take(atomic_int *count, int most) { return atomic_fetch_add(count, 1) < most; }

#endif
