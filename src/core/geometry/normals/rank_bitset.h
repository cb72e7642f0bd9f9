// rank_bitset.h: a set of numbers, stored as bits, that also counts the members below a given number.
#ifndef RANK_BITSET_H
#define RANK_BITSET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

#endif
