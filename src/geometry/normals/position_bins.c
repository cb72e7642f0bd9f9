// position_bins.c: the corners at the positions that are seen, by ranges of positions.
#include "position_bins.h"

#include "weld.h"

#include <string.h>

enum {
    BATCH = 4 * WORD, // corners looked up at a time
    RANGE_SHIFT = 11, // positions of a range, at least 2^
    RANGES_MAX = 1 << 10,
};

static inline bool put(struct seeing *s, struct seen_lists *lists, uint32_t position, uint32_t corner)
{
    struct seen_block *block = seen_block_for_one(lists, &lists->bins[position >> s->range_shift], BLOCK_CORNERS);
    if (!block)
        return false;
    block->at.place[block->count] = (uint16_t)(position & (((uint32_t)1 << s->range_shift) - 1));
    block->at.corner[block->count++] = corner;
    return true;
}

// --- a mesh without indices

#define PENDING ((uint32_t)1 << 31) // a batch's question of that number; positions are fewer

// The position of the vertex that stands for one: the rank of the corner among those of seen triangles.
static inline uint32_t position_of_corner(const struct seeing *s, uint32_t corner)
{
    return corner == NONE ? NONE : 3 * seen_triangles_before(s, corner / 3) + corner % 3;
}

// Lists those of BATCH or fewer corners from `first` on that lie at positions of the table. What was asked
// lately is not asked again.
static uint32_t look_up(const struct seeing *s, uint32_t first, uint32_t count, struct seen_answer *answers,
                        uint32_t corners[BATCH], uint32_t positions[BATCH], size_t *steps)
{
    uint32_t asked[BATCH], hash[BATCH], said[BATCH], passing = 0, asking = 0, listed = 0;
    for (uint32_t at = first; at < first + count; at += WORD) {
        uint32_t hashes[WORD], some = first + count - at < WORD ? first + count - at : WORD;
        uint64_t passed = s->search->ask(point_of(s, at), some, &s->table.filter, hashes);
        for (; passed; passed &= passed - 1) {
            uint32_t i = (uint32_t)__builtin_ctzll(passed), bits[3];
            struct seen_answer *answer = &answers[hashes[i] & s->answers_mask];
            position_bits(point_of(s, at + i), bits);
            if (!same_bits(answer->bits, bits)) {
                __builtin_prefetch(&s->table.lines[seen_table_start(&s->table, hashes[i])]);
                copy_bits(answer->bits, bits);
                answer->position = PENDING | asking;
                hash[asking] = hashes[i];
                asked[asking++] = at + i;
            }
            corners[passing] = at + i;
            positions[passing++] = answer->position;
        }
    }
    for (uint32_t k = 0; k < asking; k++) {
        struct seen_answer *answer = &answers[hash[k] & s->answers_mask];
        uint32_t bits[3];
        position_bits(point_of(s, asked[k]), bits);
        said[k] = position_of_corner(s, seen_table_find(&s->table, bits, hash[k], steps));
        if (answer->position == (PENDING | k))
            answer->position = said[k];
    }
    for (uint32_t k = 0; k < passing; k++) {
        uint32_t position = positions[k];
        if (position != NONE && position & PENDING)
            position = said[position & ~PENDING];
        corners[listed] = corners[k];
        positions[listed] = position;
        listed += position != NONE;
    }
    return listed;
}

// --- any mesh

static void bin_chunk(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!should_continue(&s->loop))
        return;
    const uint32_t *indices = s->mesh->indices, *position_of = s->position_of;
    uint32_t end = (uint32_t)piece_end(index, s->corners, CHUNK), count;
    size_t steps = 0;
    for (uint32_t c = (uint32_t)(index * CHUNK); c < end; c += count) {
        uint32_t corners[BATCH + WORD], positions[BATCH + WORD], listed = 0;
        count = end - c < BATCH ? end - c : BATCH;
        if (position_of && indices)
            listed = s->search->list(indices + c, position_of, c, count, corners, positions);
        else if (position_of)
            for (uint32_t i = c; i < c + count; i++) {
                corners[listed] = i;
                positions[listed] = position_of[i];
                listed += position_of[i] != NONE;
            }
        else
            listed = look_up(s, c, count, s->answers[thread], corners, positions, &steps);
        if (!position_of && !few_steps(s, steps, CHUNK))
            return;
        for (uint32_t k = 0; k < listed; k++)
            if (!put(s, &s->lists[thread], positions[k], corners[k]))
                return;
    }
}

bool bin_corners(struct seeing *s)
{
    s->range_shift = RANGE_SHIFT;
    while (s->range_shift < 16 && s->positions >> s->range_shift >= RANGES_MAX)
        s->range_shift++;
    s->ranges = (s->positions >> s->range_shift) + 1;
    for (int i = 0; i < pool_threads(s->pool); i++) {
        s->lists[i].bins = seeing_take_zeroed(s, s->ranges * sizeof *s->lists[i].bins);
        if (!s->lists[i].bins) {
            no_memory(&s->loop);
            return false;
        }
    }
    pool_run(s->pool, pieces_of(s->corners, CHUNK), bin_chunk, s);
    return should_continue(&s->loop) && (s->position_of || !s->crowded);
}

size_t corners_in_range(const struct seeing *s, size_t range)
{
    size_t count = 0;
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct seen_block *b = s->lists[t].bins[range]; b; b = b->before)
            count += b->count;
    return count;
}

void sort_range(const struct seeing *s, size_t range, uint32_t *restrict sorted, uint32_t *restrict starts)
{
    size_t size = (size_t)1 << s->range_shift;
    uint32_t end = 0;
    memset(starts, 0, (size + 1) * sizeof *starts);
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct seen_block *b = s->lists[t].bins[range]; b; b = b->before)
            for (uint32_t i = 0; i < b->count; i++)
                starts[b->at.place[i]]++;
    for (size_t i = 0; i <= size; i++)
        starts[i] = end += starts[i];
    // From the back, and from the newest block to the oldest: a thread's corners then come in order.
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct seen_block *b = s->lists[t].bins[range]; b; b = b->before)
            for (uint32_t i = b->count; i-- > 0;)
                sorted[--starts[b->at.place[i]]] = b->at.corner[i];
}
