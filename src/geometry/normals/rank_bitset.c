// rank_bitset.c: lists that threads fill.
#include "rank_bitset.h"

void *spare_take(struct spare *spare, struct arena *arena, size_t count, size_t size)
{
    size_t bytes, used = __atomic_load_n(&spare->used, __ATOMIC_RELAXED);
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 4)
        return NULL;
    size_t whole = (bytes + 63) / 64 * 64;
    while (whole <= spare->room - used)
        if (__atomic_compare_exchange_n(&spare->used, &used, used + whole, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
            return (char *)spare->memory + used;
    return arena_alloc(arena, bytes);
}

void *spare_lend(struct spare *spare, size_t bytes)
{
    size_t whole = (bytes + 63) / 64 * 64;
    if (whole > (spare->room - spare->used) / 64 * 64)
        return NULL;
    spare->lent += whole + spare->room % 64;
    spare->room -= whole + spare->room % 64;
    return (char *)spare->memory + spare->room;
}

void spare_give_back(struct spare *spare)
{
    spare->room += spare->lent;
    spare->lent = 0;
}

struct seen_block *seen_block_new(struct seen_lists *lists, struct seen_block *before)
{
    struct seen_block *block = lists->unused;
    if (block) {
        lists->unused = block->before;
    } else {
        if (lists->slab_left < BLOCK_BYTES) {
            lists->slab = spare_take(lists->spare, &lists->arena, 1, lists->slab_bytes);
            lists->slab_left = lists->slab ? lists->slab_bytes : 0;
            if (!lists->slab) {
                no_memory(lists->loop);
                return NULL;
            }
        }
        block = (struct seen_block *)lists->slab;
        lists->slab += BLOCK_BYTES;
        lists->slab_left -= BLOCK_BYTES;
    }
    block->before = before;
    block->count = 0;
    return block;
}

void seen_blocks_reuse(struct seen_lists *lists, struct seen_block **list)
{
    for (struct seen_block *block = *list, *before; block; block = before) {
        before = block->before;
        block->before = lists->unused;
        lists->unused = block;
    }
    *list = NULL;
}
