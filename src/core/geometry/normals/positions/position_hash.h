// position_hash.h: a hash table of positions, each represented by one vertex.
//
// The table and its filter are divided into sections by the hash. First, each thread distributes its vertices to the
// sections (block_list.h). Then each section is filled by a single thread. A section fits into the processor's cache.
#ifndef POSITION_HASH_H
#define POSITION_HASH_H

#include "block_list.h"
#include "position_simd.h"

// Four slots, which fill a cache line and are compared together.
struct position_slots {
    int32_t bits[3][4];
    int32_t vertex[4]; // NONE if this slot and all slots after it are free
};

struct position_hash {
    struct position_slots *lines;
    struct position_filter filter;
    uint32_t part_bits; // bits of the hash that select one of 2^part_bits sections
    uint32_t part_lines, part_words;
};

// Chooses the number of sections for about this many vertices.
void position_hash_plan(struct position_hash *table, size_t vertices);

// Returns the size of the table in bytes, for this many vertices in all sections together. `strict` doubles the bits of
// the filter, so that fewer positions outside the table pass the filter.
size_t position_hash_size(struct position_hash *table, size_t vertices, bool strict);
void position_hash_place(struct position_hash *table, void *memory);

static inline uint32_t position_hash_parts(const struct position_hash *table)
{
    return (uint32_t)1 << table->part_bits;
}

static inline uint32_t position_hash_part(const struct position_hash *table, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash << table->part_bits >> 32);
}

// Returns the cache line at which the search for a hash starts.
static inline size_t position_hash_start(const struct position_hash *table, uint32_t hash)
{
    return (size_t)(hash * ((uint64_t)table->part_lines << table->part_bits) >> 32);
}

// Copies the integers one by one, because a wide load would have to wait for the narrow stores before it.
static inline void copy_bits(uint32_t to[3], const uint32_t from[3])
{
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
}

// Returns the vertex that represents a position, or NONE if the position is not in the table. Increases *probes by the
// number of cache lines searched after the first cache line.
uint32_t position_hash_find(const struct position_hash *table, const uint32_t bits[3], uint32_t hash, size_t *probes);

// Fills one section of the table with the entries of its bin in each thread's list, then empties these bins. With
// `duplicates`, each vertex whose position another vertex represents is added to the list of duplicates of `mine`.
// Returns false if the probe limit is reached or memory runs out.
bool position_hash_fill(struct position_hash *table, uint32_t part, struct block_lists *lists, int threads,
                        struct block_lists *mine, bool duplicates);

// Returns true if there are so many probes that the file was probably made to cause collisions.
static inline bool probe_limit_exceeded(size_t probes, size_t searches) { return probes > 16 * searches + 4096; }

#endif
