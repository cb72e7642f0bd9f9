// scratch_memory.c: shares the caller's memory among several steps.
#include "scratch_memory.h"

void *scratch_take(struct scratch_memory *scratch, struct arena *arena, size_t count, size_t size)
{
    size_t bytes, used = __atomic_load_n(&scratch->used, __ATOMIC_RELAXED);
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 4)
        return NULL;
    size_t whole = (bytes + 63) / 64 * 64;
    while (whole <= scratch->capacity - used)
        if (__atomic_compare_exchange_n(&scratch->used, &used, used + whole, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
            return (char *)scratch->memory + used;
    return arena_alloc(arena, bytes);
}

void *scratch_borrow(struct scratch_memory *scratch, size_t bytes)
{
    size_t whole = (bytes + 63) / 64 * 64;
    if (whole > (scratch->capacity - scratch->used) / 64 * 64)
        return NULL;
    scratch->borrowed += whole + scratch->capacity % 64;
    scratch->capacity -= whole + scratch->capacity % 64;
    return (char *)scratch->memory + scratch->capacity;
}

void scratch_return(struct scratch_memory *scratch)
{
    scratch->capacity += scratch->borrowed;
    scratch->borrowed = 0;
}
