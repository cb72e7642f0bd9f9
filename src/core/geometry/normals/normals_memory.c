// normals_memory.c: implements lists of blocks that threads fill.
#include "normals_memory.h"

struct list_block *list_block_new(struct block_lists *lists, struct list_block *previous)
{
    struct list_block *block = lists->unused;
    if (block) {
        lists->unused = block->previous;
    } else {
        if (lists->slab_left < BLOCK_BYTES) {
            lists->slab = scratch_take(lists->scratch, &lists->arena, 1, lists->slab_bytes);
            lists->slab_left = lists->slab ? lists->slab_bytes : 0;
            if (!lists->slab)
                return no_memory(lists->loop), NULL;
        }
        block = (struct list_block *)lists->slab;
        lists->slab += BLOCK_BYTES;
        lists->slab_left -= BLOCK_BYTES;
    }
    block->previous = previous;
    block->count = 0;
    return block;
}

void list_blocks_recycle(struct block_lists *lists, struct list_block **list)
{
    for (struct list_block *block = *list, *previous; block; block = previous) {
        previous = block->previous;
        block->previous = lists->unused;
        lists->unused = block;
    }
    *list = NULL;
}

// --- computes the ranks of a set's members.

void rank_bitset_finish(struct rank_bitset *set)
{
    uint32_t count = 0;
    for (size_t i = 0; i < rank_bitset_words(set->size); i++) {
        set->ranks[i] = count;
        count += count_bits(set->bits[i]);
    }
    set->count = count;
}

// --- shares the caller's memory among several steps.

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
