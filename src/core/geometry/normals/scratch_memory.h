// scratch_memory.h: shares the caller's memory among several steps.
#ifndef SCRATCH_MEMORY_H
#define SCRATCH_MEMORY_H

#include "arena.h"

// Memory of the caller, aligned to 64 bytes, that may be overwritten. Reusing this memory is faster than the first
// access to new memory.
struct scratch_memory {
    void *memory;
    size_t capacity, used;
    size_t borrowed; // bytes borrowed from the end of the memory, after `capacity`
};

// Allocates from the scratch memory, or from the arena if the scratch memory is exhausted. Returns NULL if memory runs
// out. Any thread may call this function.
void *scratch_take(struct scratch_memory *scratch, struct arena *arena, size_t count, size_t size);

// Borrows the end of the scratch memory until scratch_return. No other thread may allocate from the scratch memory
// before scratch_return. Returns NULL if the scratch memory is too small.
void *scratch_borrow(struct scratch_memory *scratch, size_t bytes);
void scratch_return(struct scratch_memory *scratch);

#endif
