// position_hash.c: a hash table of positions.
#include "positions.h"

#include "cpu_features.h"

#define LANES 4
#include "lanes.h"

#include <string.h>

enum {
    PART = 1 << 14, // approximate number of vertices per section
    PART_BITS_MAX = 12,
};

CPU_VERSIONS(const struct position_simd, position_simd);

const struct position_simd *position_simd_for(int lanes) { return CPU_WIDEST(lanes, position_simd); }

void position_hash_plan(struct position_hash *table, size_t vertices)
{
    table->part_bits = 0;
    while (table->part_bits < PART_BITS_MAX && vertices >> table->part_bits > PART)
        table->part_bits++;
}

size_t position_hash_size(struct position_hash *table, size_t vertices, bool strict)
{
    size_t usual = vertices >> table->part_bits;
    table->part_lines = (uint32_t)(usual / 8 * 3 + 16);
    unsigned word_bits = 4;
    while (word_bits + table->part_bits < 28 && (size_t)(strict ? 4 : 8) << word_bits <= usual)
        word_bits++;
    table->part_words = (uint32_t)1 << word_bits;
    table->filter.shift = 32 - word_bits - table->part_bits;
    return position_hash_parts(table) *
           (table->part_lines * sizeof *table->lines + table->part_words * sizeof *table->filter.words);
}

void position_hash_place(struct position_hash *table, void *memory)
{
    table->lines = memory;
    table->filter.words = (uint32_t *)(table->lines + position_hash_parts(table) * (size_t)table->part_lines);
}

// Returns the cache line that contains a position. If there is none, returns the first cache line with a free slot for
// the position. *same and *unused receive the matching and the free slots of this line as bits.
static inline struct position_slots *seek(const struct position_hash *table, const uint32_t bits[3], uint32_t hash,
                                          unsigned *same, unsigned *unused, size_t *probes)
{
    size_t first = (size_t)position_hash_part(table, hash) * table->part_lines, last = first + table->part_lines - 1;
    inum x = inum_of((int32_t)bits[0]), y = inum_of((int32_t)bits[1]), z = inum_of((int32_t)bits[2]);
    for (size_t i = position_hash_start(table, hash);; i = i == last ? first : i + 1, ++*probes) {
        struct position_slots *line = &table->lines[i];
        mask equal =
            both(both(inum_load(line->bits[0]) == x, inum_load(line->bits[1]) == y), inum_load(line->bits[2]) == z);
        inum vertex = inum_load(line->vertex);
        *same = mask_bits(both(equal, vertex != -1));
        *unused = mask_bits(vertex == -1);
        if (*same | *unused)
            return line;
    }
}

uint32_t position_hash_find(const struct position_hash *table, const uint32_t bits[3], uint32_t hash, size_t *probes)
{
    unsigned same, unused;
    const struct position_slots *line = seek(table, bits, hash, &same, &unused, probes);
    return same ? (uint32_t)line->vertex[__builtin_ctz(same)] : NONE;
}

bool position_hash_fill(struct position_hash *table, uint32_t part, struct block_lists *lists, int threads,
                        struct block_lists *mine, bool duplicates)
{
    size_t max = 4 * (size_t)table->part_lines / 8 * 7, used = 0, probes = 0, total = 0;
    memset(table->lines + (size_t)part * table->part_lines, 0xff, table->part_lines * sizeof *table->lines);
    memset(table->filter.words + (size_t)part * table->part_words, 0, table->part_words * sizeof *table->filter.words);
    for (int t = 0; t < threads; t++) {
        for (const struct list_block *block = lists[t].bins[part]; block; block = block->previous) {
            total += block->count;
            for (uint32_t i = 0; i < block->count; i++) {
                const struct vertex_key *key = &block->key[i];
                uint32_t hash = hash_position(key->bits);
                unsigned same, unused;
                struct position_slots *line = seek(table, key->bits, hash, &same, &unused, &probes);
                if (!same) {
                    unsigned slot = (unsigned)__builtin_ctz(unused);
                    for (int a = 0; a < 3; a++)
                        line->bits[a][slot] = (int32_t)key->bits[a];
                    line->vertex[slot] = (int32_t)key->vertex;
                    table->filter.words[hash >> table->filter.shift] |= position_filter_bits(hash);
                    used++;
                } else if (duplicates) {
                    struct list_block *to = list_block_with_space(mine, &mine->duplicates, BLOCK_DUPLICATES);
                    if (!to)
                        return false;
                    to->duplicates[to->count][0] = key->vertex;
                    to->duplicates[to->count++][1] = (uint32_t)line->vertex[__builtin_ctz(same)];
                }
                if (used > max || probe_limit_exceeded(probes, total))
                    return false;
            }
        }
        list_blocks_recycle(mine, &lists[t].bins[part]);
    }
    return true;
}
