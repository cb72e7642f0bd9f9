// rank_bitset.c: computes the ranks of a set's members.
#include "rank_bitset.h"

void rank_bitset_finish(struct rank_bitset *set)
{
    uint32_t count = 0;
    for (size_t i = 0; i < rank_bitset_words(set->size); i++) {
        set->ranks[i] = count;
        count += count_bits(set->bits[i]);
    }
    set->count = count;
}
