// block_list.h: lists that threads fill while corners are sorted by position. A list is a chain of blocks of equal
// size, which are reused after they have been read.
#ifndef BLOCK_LIST_H
#define BLOCK_LIST_H

#include "loop_status.h"
#include "scratch_memory.h"

#define NONE UINT32_MAX

// A vertex, and the bits of its position (position_simd.h).
struct vertex_key {
    uint32_t bits[3];
    uint32_t vertex;
};

enum {
    BLOCK_CORNERS = 338,
    BLOCK_KEYS = 127,
    BLOCK_DUPLICATES = 254,
    BLOCK_BYTES = 2048,
};

struct list_block {
    struct list_block *previous;
    uint32_t count, unused;
    union {
        struct {
            uint16_t position[BLOCK_CORNERS]; // within a range of positions
            uint32_t corner[BLOCK_CORNERS];
        } at;
        struct vertex_key key[BLOCK_KEYS];
        uint32_t duplicates[BLOCK_DUPLICATES][2]; // a vertex, and the vertex that represents its position
    };
};
_Static_assert(sizeof(struct list_block) <= BLOCK_BYTES, "a list's block must fit into BLOCK_BYTES");

// The lists of one thread.
struct block_lists {
    struct arena arena;
    struct scratch_memory *scratch; // shared by all threads
    struct loop_status *loop;       // set to stopped if memory runs out
    size_t slab_bytes;
    char *slab;
    size_t slab_left;
    struct list_block *unused;
    struct list_block **bins; // the newest block of each bin
    struct list_block *duplicates;
};

// Returns an empty block whose previous block is `previous`, or NULL if memory runs out.
struct list_block *list_block_new(struct block_lists *lists, struct list_block *previous);

// Returns a block of a list with space for one more entry, or NULL if memory runs out. A block has space for `capacity`
// entries.
static inline struct list_block *list_block_with_space(struct block_lists *lists, struct list_block **list,
                                                       uint32_t capacity)
{
    if (*list && (*list)->count < capacity)
        return *list;
    struct list_block *block = list_block_new(lists, *list);
    if (block)
        *list = block;
    return block;
}

// Makes the blocks of a list available again after the list has been read. The list is then empty.
void list_blocks_recycle(struct block_lists *lists, struct list_block **list);

#endif
