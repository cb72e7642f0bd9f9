// position_hash.h: the positions of shown vertices, by hash: one vertex stands for each.
//
// The table and its filter are cut into parts by the hash. First each thread spreads the vertices that it
// finds over the parts, then each part is filled by one thread, in its cache.
#ifndef POSITION_HASH_H
#define POSITION_HASH_H

#include "position_simd.h"
#include "rank_bitset.h"

// Four slots: a cache line, looked at as a whole.
struct seen_line {
    int32_t bits[3][4];
    int32_t vertex[4]; // NONE: free, as are those behind it
};

struct seen_table {
    struct seen_line *lines;
    struct seen_filter filter;
    uint32_t part_bits; // of the hash; there are 2^part_bits parts
    uint32_t part_lines, part_words;
};

// Plans as many parts as suit so many vertices.
void seen_table_plan(struct seen_table *table, size_t vertices);

// How many bytes the table takes for so many vertices in all parts together, and where it is. The filter
// takes few bits for each, or twice as many, so that few others pass.
size_t seen_table_size(struct seen_table *table, size_t vertices, bool strict);
void seen_table_place(struct seen_table *table, void *memory);

static inline uint32_t seen_table_parts(const struct seen_table *table) { return (uint32_t)1 << table->part_bits; }

static inline uint32_t seen_table_part(const struct seen_table *table, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash << table->part_bits >> 32);
}

// The line in which the search for a hash starts, one of its part's.
static inline size_t seen_table_start(const struct seen_table *table, uint32_t hash)
{
    return (size_t)(hash * ((uint64_t)table->part_lines << table->part_bits) >> 32);
}

static inline bool same_bits(const uint32_t a[3], const uint32_t b[3])
{
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
}

// Number by number: what was written so is not read as a whole soon.
static inline void copy_bits(uint32_t to[3], const uint32_t from[3])
{
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
}

// The vertex that stands for a position; NONE: it is not in the table. Adds the steps beyond the first line.
uint32_t seen_table_find(const struct seen_table *table, const uint32_t bits[3], uint32_t hash, size_t *steps);

// Fills a part from its bin in each of `threads` lists, which is empty then; with `doubles`, each vertex at a
// position that another one stands for goes to that list of `mine`. False: too many steps, or no memory.
bool seen_table_fill(struct seen_table *table, uint32_t part, struct seen_lists *lists, int threads,
                     struct seen_lists *mine, bool doubles);

#endif
