// scratch_memory.h: lets several steps share the caller's memory.
#ifndef SCRATCH_MEMORY_H
#define SCRATCH_MEMORY_H

#include "arena.h"

// Memory of the caller, aligned to 64 bytes, that may be overwritten: fresh memory costs more to touch than to use.
struct scratch_memory {
    void *memory;
    size_t capacity, used;
    size_t borrowed; // bytes at its end, after `capacity`
};

// Memory from the scratch memory while it lasts, else from the arena, or NULL if memory runs out. Any thread.
void *scratch_take(struct scratch_memory *scratch, struct arena *arena, size_t count, size_t size);

// Takes the end of the scratch memory until scratch_return, or NULL if it is smaller. Only while no other thread takes
// any.
void *scratch_borrow(struct scratch_memory *scratch, size_t bytes);
void scratch_return(struct scratch_memory *scratch);

#endif
