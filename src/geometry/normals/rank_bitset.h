// rank_bitset.h: lists that threads fill while they look for the corners at the positions that are seen:
// blocks of one size, which serve again once they were read.
#ifndef RANK_BITSET_H
#define RANK_BITSET_H

#include "arena.h"
#include "loop_status.h"
#include "visible_normals.h"

#define NONE UINT32_MAX

// A vertex and the bits of its position (weld.h).
struct seen_key {
    uint32_t bits[3];
    uint32_t vertex;
};

enum {
    BLOCK_CORNERS = 338,
    BLOCK_KEYS = 127,
    BLOCK_DOUBLES = 254,
    BLOCK_BYTES = 2048,
};

struct seen_block {
    struct seen_block *before;
    uint32_t count, unused;
    union {
        struct {
            uint16_t place[BLOCK_CORNERS]; // of its position in a range
            uint32_t corner[BLOCK_CORNERS];
        } at;
        struct seen_key key[BLOCK_KEYS];
        uint32_t doubles[BLOCK_DOUBLES][2]; // a vertex, and the one that stands for its position
    };
};
_Static_assert(sizeof(struct seen_block) <= BLOCK_BYTES, "blocks lie side by side");

// One thread's.
struct seen_lists {
    struct arena arena;
    struct spare *spare;      // all threads'
    struct loop_status *loop; // told when memory is out
    size_t slab_bytes;
    char *slab;
    size_t slab_left;
    struct seen_block *unused;
    struct seen_block **bins; // the newest block of each bin
    struct seen_block *doubles;
};

// Memory from the spare one while there is some, else from the arena; NULL: out of memory. Any thread.
void *spare_take(struct spare *spare, struct arena *arena, size_t count, size_t size);

// Lends the end of the spare memory until it is given back; NULL: it is smaller. While no thread takes any.
void *spare_lend(struct spare *spare, size_t bytes);
void spare_give_back(struct spare *spare);

// An empty block in front of `before`; NULL: out of memory.
struct seen_block *seen_block_new(struct seen_lists *lists, struct seen_block *before);

// The block of a list with room for one more of those that a block has `room` for; NULL: out of memory.
static inline struct seen_block *seen_block_for_one(struct seen_lists *lists, struct seen_block **list, uint32_t room)
{
    if (*list && (*list)->count < room)
        return *list;
    struct seen_block *block = seen_block_new(lists, *list);
    if (block)
        *list = block;
    return block;
}

// The blocks of a list were read: they may be filled anew.
void seen_blocks_reuse(struct seen_lists *lists, struct seen_block **list);

#endif
