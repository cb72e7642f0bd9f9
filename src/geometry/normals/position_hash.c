// position_hash.c: the positions of shown vertices, by hash.
#include "position_hash.h"

#include "cpu_features.h"

#define LANES 4
#include "lanes.h"

#include <string.h>

enum {
    PART = 1 << 11, // vertices aimed at in a part
    PART_BITS = 12, // at most
};

extern const struct seen_lanes seen_lanes_scalar, seen_lanes_avx2, seen_lanes_avx512;

const struct seen_lanes *seen_lanes_of(int lanes)
{
    return CPU_WIDEST(lanes, &seen_lanes_scalar, &seen_lanes_avx2, &seen_lanes_avx512);
}

void seen_table_plan(struct seen_table *table, size_t vertices)
{
    table->part_bits = 0;
    while (table->part_bits < PART_BITS && vertices >> table->part_bits > PART)
        table->part_bits++;
}

size_t seen_table_size(struct seen_table *table, size_t vertices, bool strict)
{
    size_t usual = vertices >> table->part_bits;
    table->part_lines = (uint32_t)(usual / 8 * 3 + 16);
    unsigned word_bits = 4;
    while (word_bits + table->part_bits < 28 && (size_t)(strict ? 4 : 8) << word_bits <= usual)
        word_bits++;
    table->part_words = (uint32_t)1 << word_bits;
    table->filter.shift = 32 - word_bits - table->part_bits;
    return seen_table_parts(table) *
           (table->part_lines * sizeof *table->lines + table->part_words * sizeof *table->filter.words);
}

void seen_table_place(struct seen_table *table, void *memory)
{
    table->lines = memory;
    table->filter.words = (uint32_t *)(table->lines + seen_table_parts(table) * (size_t)table->part_lines);
}

// Looks for a position from the line where its search starts: the line that holds it or has a free slot for
// it, and, as bits, the slots that hold it and those that are free.
static inline struct seen_line *seek(const struct seen_table *table, const uint32_t bits[3], uint32_t hash,
                                     unsigned *same, unsigned *unused, size_t *steps)
{
    size_t first = (size_t)seen_table_part(table, hash) * table->part_lines, last = first + table->part_lines - 1;
    inum x = inum_of((int32_t)bits[0]), y = inum_of((int32_t)bits[1]), z = inum_of((int32_t)bits[2]);
    for (size_t i = seen_table_start(table, hash);; i = i == last ? first : i + 1, ++*steps) {
        struct seen_line *line = &table->lines[i];
        mask equal =
            both(both(inum_load(line->bits[0]) == x, inum_load(line->bits[1]) == y), inum_load(line->bits[2]) == z);
        inum vertex = inum_load(line->vertex);
        *same = mask_bits(both(equal, vertex != -1));
        *unused = mask_bits(vertex == -1);
        if (*same | *unused)
            return line;
    }
}

uint32_t seen_table_find(const struct seen_table *table, const uint32_t bits[3], uint32_t hash, size_t *steps)
{
    unsigned same, unused;
    const struct seen_line *line = seek(table, bits, hash, &same, &unused, steps);
    return same ? (uint32_t)line->vertex[__builtin_ctz(same)] : NONE;
}

bool seen_table_fill(struct seen_table *table, uint32_t part, struct seen_lists *lists, int threads,
                     struct seen_lists *mine, bool doubles)
{
    size_t most = 4 * (size_t)table->part_lines / 8 * 7, used = 0, steps = 0, total = 0;
    memset(table->lines + (size_t)part * table->part_lines, 0xff, table->part_lines * sizeof *table->lines);
    memset(table->filter.words + (size_t)part * table->part_words, 0, table->part_words * sizeof *table->filter.words);
    for (int t = 0; t < threads; t++) {
        for (const struct seen_block *block = lists[t].bins[part]; block; block = block->before) {
            total += block->count;
            for (uint32_t i = 0; i < block->count; i++) {
                const struct seen_key *key = &block->key[i];
                uint32_t hash = seen_hash(key->bits);
                unsigned same, unused;
                struct seen_line *line = seek(table, key->bits, hash, &same, &unused, &steps);
                if (!same) {
                    unsigned slot = (unsigned)__builtin_ctz(unused);
                    for (int a = 0; a < 3; a++)
                        line->bits[a][slot] = (int32_t)key->bits[a];
                    line->vertex[slot] = (int32_t)key->vertex;
                    table->filter.words[hash >> table->filter.shift] |= seen_filter_bits(hash);
                    used++;
                } else if (doubles) {
                    struct seen_block *to = seen_block_for_one(mine, &mine->doubles, BLOCK_DOUBLES);
                    if (!to)
                        return false;
                    to->doubles[to->count][0] = key->vertex;
                    to->doubles[to->count++][1] = (uint32_t)line->vertex[__builtin_ctz(same)];
                }
                if (used > most || steps > 16 * total + 4096)
                    return false;
            }
        }
        seen_blocks_reuse(mine, &lists[t].bins[part]);
    }
    return true;
}
