// position_bins.c: collects the corners at shared positions and sorts them into bins, one for each range of positions.
#include "positions.h"

#include <string.h>

enum {
    BATCH = 4 * WORD, // corners per lookup
    SHIFT_MIN = 11,   // a bin has at least 2^SHIFT_MIN positions
    SHIFT_MAX = 16,   // list_block.at.position
    BINS_MAX = 1 << 10,
};

static inline bool put(const struct position_bins *bins, struct block_lists *lists, uint32_t position, uint32_t corner)
{
    struct list_block *block = list_block_with_space(lists, &lists->bins[position >> bins->shift], BLOCK_CORNERS);
    if (!block)
        return false;
    block->at.position[block->count] = (uint16_t)(position & (((uint32_t)1 << bins->shift) - 1));
    block->at.corner[block->count++] = corner;
    return true;
}

// --- meshes without indices

#define PENDING ((uint32_t)1 << 31) // marks a pending lookup; it is larger than any position

// Returns the number of the position that a corner represents: the corner's rank among the corners of the set's
// triangles.
static inline uint32_t position_of_corner(const struct position_search *s, uint32_t corner)
{
    return corner == NONE ? NONE : 3 * triangles_before(s, corner / 3) + corner % 3;
}

// Looks up at most BATCH corners, starting with `first`, and lists the corners whose positions are in the table.
// Positions that were looked up recently are found in the cache.
static uint32_t look_up(const struct position_search *s, uint32_t first, uint32_t count, struct cached_position *cache,
                        uint32_t corners[BATCH], uint32_t positions[BATCH], size_t *probes)
{
    uint32_t looked_up[BATCH], hash[BATCH], found[BATCH], passing = 0, lookups = 0, listed = 0;
    for (uint32_t at = first; at < first + count; at += WORD) {
        uint32_t hashes[WORD], some = first + count - at < WORD ? first + count - at : WORD;
        uint64_t passed = s->simd->test(point_of(s, at), some, &s->table.filter, hashes);
        for (; passed; passed &= passed - 1) {
            uint32_t i = (uint32_t)__builtin_ctzll(passed), bits[3];
            struct cached_position *cached = &cache[hashes[i] & s->caches_mask];
            position_bits(point_of(s, at + i), bits);
            if (!same_position(cached->bits, bits)) {
                __builtin_prefetch(&s->table.lines[position_hash_start(&s->table, hashes[i])]);
                copy_bits(cached->bits, bits);
                cached->position = PENDING | lookups;
                hash[lookups] = hashes[i];
                looked_up[lookups++] = at + i;
            }
            corners[passing] = at + i;
            positions[passing++] = cached->position;
        }
    }
    for (uint32_t k = 0; k < lookups; k++) {
        struct cached_position *cached = &cache[hash[k] & s->caches_mask];
        uint32_t bits[3];
        position_bits(point_of(s, looked_up[k]), bits);
        found[k] = position_of_corner(s, position_hash_find(&s->table, bits, hash[k], probes));
        if (cached->position == (PENDING | k))
            cached->position = found[k];
    }
    for (uint32_t k = 0; k < passing; k++) {
        uint32_t position = positions[k];
        if (position != NONE && position & PENDING)
            position = found[position & ~PENDING];
        corners[listed] = corners[k];
        positions[listed] = position;
        listed += position != NONE;
    }
    return listed;
}

// --- all meshes

static void fill_from_chunk(void *user, size_t index, int thread)
{
    const struct position_bins *bins = user;
    struct position_search *s = bins->search;
    if (!should_continue(&s->loop))
        return;
    const uint32_t *indices = s->mesh->indices, *position_of = s->position_of;
    uint32_t end = (uint32_t)chunk_end(index, s->corners, CHUNK), count;
    size_t probes = 0;
    for (uint32_t c = (uint32_t)(index * CHUNK); c < end; c += count) {
        uint32_t corners[BATCH + WORD], positions[BATCH + WORD], listed = 0;
        count = end - c < BATCH ? end - c : BATCH;
        if (position_of && indices)
            listed = s->simd->list(indices + c, position_of, c, count, corners, positions);
        else if (position_of)
            for (uint32_t i = c; i < c + count; i++) {
                corners[listed] = i;
                positions[listed] = position_of[i];
                listed += position_of[i] != NONE;
            }
        else
            listed = look_up(s, c, count, s->caches[thread], corners, positions, &probes);
        if (!position_of && !within_probe_limit(s, probes, CHUNK))
            return;
        for (uint32_t k = 0; k < listed; k++)
            if (!put(bins, &s->lists[thread], positions[k], corners[k]))
                return;
    }
}

bool position_bins_fill(struct position_bins *bins, struct position_search *s)
{
    *bins = (struct position_bins){.search = s, .shift = SHIFT_MIN};
    while (bins->shift < SHIFT_MAX && s->positions >> bins->shift >= BINS_MAX)
        bins->shift++;
    bins->count = (s->positions >> bins->shift) + 1;
    for (int i = 0; i < pool_threads(s->pool); i++) {
        s->lists[i].bins = search_alloc_zeroed(s, bins->count * sizeof *s->lists[i].bins);
        if (!s->lists[i].bins) {
            no_memory(&s->loop);
            return false;
        }
    }
    pool_run(s->pool, chunks_of(s->corners, CHUNK), fill_from_chunk, bins);
    return should_continue(&s->loop) && (s->position_of || !s->probe_limit_reached);
}

size_t position_bin_corners(const struct position_bins *bins, size_t bin)
{
    const struct position_search *s = bins->search;
    size_t count = 0;
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct list_block *b = s->lists[t].bins[bin]; b; b = b->previous)
            count += b->count;
    return count;
}

void position_bin_sort(const struct position_bins *bins, size_t bin, uint32_t *restrict sorted,
                       uint32_t *restrict starts)
{
    const struct position_search *s = bins->search;
    size_t size = (size_t)1 << bins->shift;
    uint32_t end = 0;
    memset(starts, 0, (size + 1) * sizeof *starts);
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct list_block *b = s->lists[t].bins[bin]; b; b = b->previous)
            for (uint32_t i = 0; i < b->count; i++)
                starts[b->at.position[i]]++;
    for (size_t i = 0; i <= size; i++)
        starts[i] = end += starts[i];
    // Lists are read backwards, from the newest block to the oldest, so that a thread's corners are in order.
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct list_block *b = s->lists[t].bins[bin]; b; b = b->previous)
            for (uint32_t i = b->count; i-- > 0;)
                sorted[--starts[b->at.position[i]]] = b->at.corner[i];
}
