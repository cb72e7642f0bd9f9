// normals_memory.h: lists that threads fill while corners are sorted by position. A list is a chain of blocks of equal
// size, which are reused after they have been read.
#ifndef NORMALS_MEMORY_H
#define NORMALS_MEMORY_H

#include "arena.h"
#include "loop_status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define NONE UINT32_MAX

// A vertex, and the bits of its position (positions.h).
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

// --- A set of numbers, stored as bits, that also counts the members below a given number.

// A subset of the numbers from 0 to `size` − 1.
struct rank_bitset {
    uint64_t *bits;  // 64 numbers per word
    uint32_t *ranks; // members in the words before each word; filled by rank_bitset_finish
    size_t size;
    uint32_t count; // number of members; filled by rank_bitset_finish
};

static inline size_t rank_bitset_words(size_t size) { return (size + 63) / 64; }

// Adds the numbers whose bits are set in `bits`; bit i represents the number 64 `word` + i. Any thread may call this
// function.
static inline void rank_bitset_add_bits(struct rank_bitset *set, size_t word, uint64_t bits)
{
    if (bits & ~__atomic_load_n(&set->bits[word], __ATOMIC_RELAXED))
        __atomic_fetch_or(&set->bits[word], bits, __ATOMIC_RELAXED);
}

// Adds a number. Any thread may call this function.
static inline void rank_bitset_add(struct rank_bitset *set, size_t number)
{
    rank_bitset_add_bits(set, number / 64, (uint64_t)1 << number % 64);
}

static inline bool rank_bitset_has(const struct rank_bitset *set, size_t number)
{
    return set->bits[number / 64] >> number % 64 & 1;
}

// Returns the number of set bits. The bits are summed in pairs, in fours, and in bytes, because the baseline processor
// has no instruction that counts bits.
static inline uint32_t count_bits(uint64_t x)
{
    x -= x >> 1 & UINT64_C(0x5555555555555555);
    x = (x & UINT64_C(0x3333333333333333)) + (x >> 2 & UINT64_C(0x3333333333333333));
    x = (x + (x >> 4)) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    return (uint32_t)(x * UINT64_C(0x0101010101010101) >> 56);
}

// Returns how many members are below `number`. If `number` is a member, the result is the member's index.
static inline uint32_t rank_bitset_rank(const struct rank_bitset *set, size_t number)
{
    return set->ranks[number / 64] + count_bits(set->bits[number / 64] & (((uint64_t)1 << number % 64) - 1));
}

// Fills `ranks` and `count` after all members are added.
void rank_bitset_finish(struct rank_bitset *set);

// --- shares the caller's memory among several steps.

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
