// block_list.c: implements lists of blocks that threads fill.
#include "block_list.h"

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
