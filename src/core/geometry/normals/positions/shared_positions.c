// shared_positions.c: finds the vertices of a mesh that are at the positions of given triangles.
//
// The vertices of these triangles are inserted into a hash table of positions. Then every other vertex of the mesh is
// looked up; a filter rejects most of them before the table is searched. The order of the threads affects only the
// addresses of data, never a normal.
#include "positions.h"

#include "corner_fan.h"

#include <stdlib.h>
#include <string.h>

enum {
    WORDS = 1 << 8,      // words of a bit set per task
    AHEAD = 16,          // distance in words at which the positions of triangles are prefetched
    TOGETHER = 8,        // words whose vertices are looked up together, after prefetching
    SLAB = 2 << 20,      // size in bytes of the blocks that are allocated together
    CACHE_MAX = 1 << 13, // positions in a thread's cache, which then fits into the processor's second-level cache
};

// Allocates memory that is used only until the first fan is computed. This memory may therefore overlap the memory for
// normals.
static void *alloc_until_fans(struct position_search *s, size_t count, size_t size)
{
    for (int i = 0; i < 2; i++) {
        struct scratch_memory *scratch = &s->until_fans[i];
        if (count <= (scratch->capacity - scratch->used) / size / 64 * 64)
            return scratch_take(scratch, &s->arena, count, size);
    }
    return search_alloc(s, &s->arena, count, size);
}

void *search_alloc_zeroed(struct position_search *s, size_t bytes)
{
    void *memory = search_alloc(s, &s->arena, bytes, 1);
    if (memory)
        memset(memory, 0, bytes);
    return memory;
}

bool within_probe_limit(struct position_search *s, size_t probes, size_t searches)
{
    if (probe_limit_exceeded(probes, searches))
        __atomic_store_n(&s->probe_limit_reached, 1, __ATOMIC_RELAXED);
    return !__atomic_load_n(&s->probe_limit_reached, __ATOMIC_RELAXED);
}

// --- the triangles of the set

static size_t first_word(const struct position_search *s) { return s->first / 64; }

static size_t triangle_words(const struct position_search *s)
{
    return rank_bitset_words(s->first + (size_t)s->mesh->triangle_count) - first_word(s);
}

// Returns the bits of the mesh's triangles in a word of the set.
static uint64_t triangle_word(const struct position_search *s, size_t word)
{
    size_t from = 64 * word, last = s->first + (size_t)s->mesh->triangle_count;
    uint64_t bits = s->triangles->bits[word];
    if (from < s->first)
        bits &= ~UINT64_C(0) << (s->first - from);
    if (from + 64 > last)
        bits &= ~UINT64_C(0) >> (from + 64 - last);
    return bits;
}

static void add_wanted(void *user, size_t index, int thread)
{
    (void)thread;
    struct position_search *s = user;
    if (!should_continue(&s->loop))
        return;
    for (size_t w = index * WORDS; w < chunk_end(index, triangle_words(s), WORDS); w++)
        for (uint64_t bits = triangle_word(s, first_word(s) + w); bits; bits &= bits - 1) {
            size_t triangle = 64 * (first_word(s) + w) + (size_t)__builtin_ctzll(bits) - s->first;
            for (size_t k = 0; k < 3; k++)
                rank_bitset_add(&s->wanted, s->mesh->indices[3 * triangle + k]);
        }
}

bool find_wanted(struct position_search *s)
{
    size_t words = rank_bitset_words(s->vertices);
    s->wanted.size = s->vertices;
    s->wanted.bits = search_alloc_zeroed(s, words * sizeof *s->wanted.bits);
    s->wanted.ranks = search_alloc(s, &s->arena, words, sizeof *s->wanted.ranks);
    if (!s->wanted.bits || !s->wanted.ranks)
        return false;
    if (triangles_before(s, s->mesh->triangle_count) < s->mesh->triangle_count) {
        pool_run(s->pool, chunks_of(triangle_words(s), WORDS), add_wanted, s);
    } else if (words) { // all vertices are wanted; a vertex without triangles becomes a position without corners
        memset(s->wanted.bits, 0xff, words * sizeof *s->wanted.bits);
        s->wanted.bits[words - 1] >>= 64 * words - s->vertices;
    }
    rank_bitset_finish(&s->wanted);
    return true;
}

// --- the table

// Puts a vertex into the bin of its section of the table, unless another vertex at its position was added recently.
static inline bool spread(struct position_search *s, int thread, size_t vertex)
{
    struct block_lists *lists = &s->lists[thread];
    uint32_t bits[3];
    position_bits(point_of(s, vertex), bits);
    uint32_t hash = hash_position(bits);
    if (s->caches) {
        struct cached_position *cached = &s->caches[thread][hash & s->caches_mask];
        if (same_position(cached->bits, bits))
            return true;
        copy_bits(cached->bits, bits);
    }
    struct list_block *block =
        list_block_with_space(lists, &lists->bins[position_hash_part(&s->table, hash)], BLOCK_KEYS);
    if (!block)
        return false;
    struct vertex_key *key = &block->key[block->count++];
    copy_bits(key->bits, bits);
    key->vertex = (uint32_t)vertex;
    return true;
}

static void spread_vertices(void *user, size_t index, int thread)
{
    struct position_search *s = user;
    if (!should_continue(&s->loop))
        return;
    for (size_t w = index * WORDS; w < chunk_end(index, rank_bitset_words(s->vertices), WORDS); w++)
        for (uint64_t bits = s->wanted.bits[w]; bits; bits &= bits - 1)
            if (!spread(s, thread, 64 * w + (size_t)__builtin_ctzll(bits)))
                return;
}

static void spread_corners(void *user, size_t index, int thread)
{
    struct position_search *s = user;
    if (!should_continue(&s->loop))
        return;
    size_t end = chunk_end(index, triangle_words(s), WORDS);
    for (size_t w = index * WORDS, ahead = w; w < end; w++) {
        for (; ahead < end && ahead < w + AHEAD; ahead++)
            for (uint64_t bits = triangle_word(s, first_word(s) + ahead); bits; bits &= bits - 1) {
                size_t triangle = 64 * (first_word(s) + ahead) + (size_t)__builtin_ctzll(bits) - s->first;
                __builtin_prefetch(point_of(s, 3 * triangle));
                __builtin_prefetch(point_of(s, 3 * triangle + 2) + 2);
            }
        for (uint64_t bits = triangle_word(s, first_word(s) + w); bits; bits &= bits - 1) {
            size_t triangle = 64 * (first_word(s) + w) + (size_t)__builtin_ctzll(bits) - s->first;
            for (size_t k = 0; k < 3; k++)
                if (!spread(s, thread, 3 * triangle + k))
                    return;
        }
    }
}

static void fill_part(void *user, size_t index, int thread)
{
    struct position_search *s = user;
    if (should_continue(&s->loop) && !position_hash_fill(&s->table, (uint32_t)index, s->lists, pool_threads(s->pool),
                                                         &s->lists[thread], s->mesh->indices != NULL))
        __atomic_store_n(&s->probe_limit_reached, 1, __ATOMIC_RELAXED);
}

static bool start_lists(struct position_search *s)
{
    size_t threads = (size_t)pool_threads(s->pool);
    // Blocks for a small model are allocated in small slabs.
    size_t slab = SLAB;
    while (slab > 16 * BLOCK_BYTES && slab / 2 > s->corners * 8)
        slab /= 2;
    size_t bytes = s->positions * sizeof(struct vertex_key);
    if (s->loop.call && !call_charge(s->loop.call, bytes))
        return false;
    s->charged += s->loop.call ? bytes : 0;
    s->lists = arena_alloc_zeroed(&s->of_threads, threads * sizeof *s->lists);
    for (size_t i = 0; s->lists && i < threads; i++) {
        struct block_lists *lists = &s->lists[i];
        *lists = (struct block_lists){.scratch = &s->scratch, .loop = &s->loop, .slab_bytes = slab};
        lists->bins = arena_alloc_zeroed(&s->of_threads, (size_t)position_hash_parts(&s->table) * sizeof *lists->bins);
        if (!lists->bins)
            return false;
    }
    return s->lists != NULL;
}

void position_search_free(struct position_search *s)
{
    for (int i = 0; s->lists && i < pool_threads(s->pool); i++)
        arena_free(&s->lists[i].arena);
    s->lists = NULL;
    arena_free(&s->arena);
    arena_free(&s->of_threads);
    if (s->charged)
        call_refund(s->loop.call, s->charged);
    s->charged = 0;
}

// Clears the cache entries: sets all their bits to one. No valid position has these bits.
static void clear_caches(struct position_search *s)
{
    for (int i = 0; i < pool_threads(s->pool); i++)
        memset(s->caches[i], 0xff, (s->caches_mask + (size_t)1) * sizeof **s->caches);
}

// Initialises the caches. In meshes without indices, the same positions occur several times, usually soon after one
// another.
static bool start_caches(struct position_search *s)
{
    size_t threads = (size_t)pool_threads(s->pool), capacity = 64;
    while (capacity < CACHE_MAX && capacity < s->corners / 4)
        capacity *= 2;
    s->caches_mask = (uint32_t)capacity - 1;
    s->caches = arena_array(&s->of_threads, threads, sizeof *s->caches);
    if (!s->caches)
        return false;
    for (size_t i = 0; i < threads; i++) {
        s->caches[i] = arena_array(&s->of_threads, capacity, sizeof **s->caches);
        if (!s->caches[i])
            return false;
    }
    clear_caches(s);
    return true;
}

static size_t count_keys(const struct position_search *s)
{
    size_t keys = 0;
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (uint32_t p = 0; p < position_hash_parts(&s->table); p++)
            for (const struct list_block *block = s->lists[t].bins[p]; block; block = block->previous)
                keys += block->count;
    return keys;
}

static bool fill_table(struct position_search *s)
{
    const bool indexed = s->mesh->indices != NULL;
    size_t wanted = indexed ? s->wanted.count : 3 * (size_t)triangles_before(s, s->mesh->triangle_count);
    s->positions = wanted;
    position_hash_plan(&s->table, wanted);
    if (!start_lists(s) || (!indexed && !start_caches(s)))
        return false;
    if (indexed)
        pool_run(s->pool, chunks_of(rank_bitset_words(s->vertices), WORDS), spread_vertices, s);
    else
        pool_run(s->pool, chunks_of(triangle_words(s), WORDS), spread_corners, s);
    size_t bytes = position_hash_size(&s->table, count_keys(s), indexed);
    void *memory = scratch_borrow(&s->scratch, bytes);
    if (!memory)
        memory = alloc_until_fans(s, bytes, 1);
    if (!memory)
        return false;
    position_hash_place(&s->table, memory);
    pool_run(s->pool, position_hash_parts(&s->table), fill_part, s);
    return true;
}

// --- the other vertices of indexed meshes

// Looks up the few vertices in the set's words [word, end) that are not wanted but pass the filter. Returns the number
// of probes.
static size_t place_some(const struct position_search *s, size_t word, size_t end)
{
    uint32_t looked_up[WORD * TOGETHER], hash[WORD * TOGETHER], lookups = 0;
    for (; word < end; word++) {
        size_t first = WORD * word, count = s->vertices - first < WORD ? s->vertices - first : WORD;
        uint64_t wanted = s->wanted.bits[word];
        uint32_t hashes[WORD];
        uint64_t passed = s->simd->test(point_of(s, first), (uint32_t)count, &s->table.filter, hashes) & ~wanted;
        for (; passed; passed &= passed - 1) {
            uint32_t i = (uint32_t)__builtin_ctzll(passed);
            __builtin_prefetch(&s->table.lines[position_hash_start(&s->table, hashes[i])]);
            looked_up[lookups] = (uint32_t)first + i;
            hash[lookups++] = hashes[i];
        }
    }
    size_t probes = 0;
    for (uint32_t k = 0; k < lookups; k++) {
        uint32_t bits[3];
        position_bits(point_of(s, looked_up[k]), bits);
        uint32_t vertex = position_hash_find(&s->table, bits, hash[k], &probes);
        if (vertex != NONE)
            s->position_of[looked_up[k]] = rank_bitset_rank(&s->wanted, vertex);
    }
    return probes;
}

static void place_words(void *user, size_t index, int thread)
{
    (void)thread;
    struct position_search *s = user;
    if (!should_continue(&s->loop))
        return;
    size_t probes = 0, end = chunk_end(index, rank_bitset_words(s->vertices), WORDS);
    for (size_t w = index * WORDS; w < end && within_probe_limit(s, probes, WORD * WORDS); w += TOGETHER)
        probes += place_some(s, w, w + TOGETHER < end ? w + TOGETHER : end);
}

// Numbers the wanted vertices whose position another vertex represents.
static void place_duplicates(void *user, size_t index, int thread)
{
    (void)thread;
    struct position_search *s = user;
    for (const struct list_block *block = s->lists[index].duplicates; block; block = block->previous)
        for (uint32_t i = 0; i < block->count; i++)
            s->position_of[block->duplicates[i][0]] = rank_bitset_rank(&s->wanted, block->duplicates[i][1]);
    list_blocks_recycle(&s->lists[index], &s->lists[index].duplicates);
}

bool number_wanted(struct position_search *s)
{
    s->position_of = alloc_until_fans(s, WORD * rank_bitset_words(s->vertices), sizeof *s->position_of);
    if (!s->position_of)
        return false;
    for (size_t w = 0; w < rank_bitset_words(s->vertices); w++)
        s->simd->number(s->wanted.bits[w], s->wanted.ranks[w], s->position_of + WORD * w);
    return true;
}

static bool place_vertices(struct position_search *s)
{
    if (!number_wanted(s))
        return false;
    pool_run(s->pool, chunks_of(rank_bitset_words(s->vertices), WORDS), place_words, s);
    pool_run(s->pool, (size_t)pool_threads(s->pool), place_duplicates, s);
    return true;
}

// --- all steps

static int compare_keys(const void *left, const void *right)
{
    const struct vertex_key *a = left, *b = right;
    for (int i = 0; i < 3; i++)
        if (a->bits[i] != b->bits[i])
            return a->bits[i] < b->bits[i] ? -1 : 1;
    return 0;
}

bool find_positions_by_sorting(struct position_search *s, lam_error *error)
{
    struct vertex_key *keys = search_alloc(s, &s->arena, s->vertices, sizeof *keys);
    uint8_t *wanted = search_alloc_zeroed(s, s->vertices); // indexed by position
    if (!s->position_of)
        s->position_of = search_alloc(s, &s->arena, s->vertices, sizeof *s->position_of);
    if (!keys || !wanted || !s->position_of)
        return call_memory_error(s->loop.call, s->vertices * sizeof *keys, error);
    for (size_t v = 0; v < s->vertices; v++) {
        position_bits(point_of(s, v), keys[v].bits);
        keys[v].vertex = (uint32_t)v;
    }
    qsort(keys, s->vertices, sizeof *keys, compare_keys);
    s->positions = 0;
    for (size_t i = 0; i < s->vertices; i++) {
        s->positions += i == 0 || !same_position(keys[i].bits, keys[i - 1].bits);
        s->position_of[keys[i].vertex] = (uint32_t)s->positions - 1;
    }
    for (size_t w = 0; w < triangle_words(s); w++)
        for (uint64_t bits = triangle_word(s, first_word(s) + w); bits; bits &= bits - 1) {
            size_t triangle = 64 * (first_word(s) + w) + (size_t)__builtin_ctzll(bits) - s->first;
            for (size_t k = 0; k < 3; k++)
                wanted[s->position_of[corner_vertex(s->mesh, 3 * triangle + k)]] = 1;
        }
    for (size_t v = 0; v < s->vertices; v++)
        if (!wanted[s->position_of[v]])
            s->position_of[v] = NONE;
    return true;
}

bool find_positions(struct position_search *s, lam_error *error)
{
    const bool indexed = s->mesh->indices != NULL;
    bool ok = fill_table(s);
    if (ok && indexed && !s->probe_limit_reached) {
        ok = place_vertices(s);
        scratch_return(&s->scratch); // the table is no longer needed
    } else if (ok && !indexed) {
        clear_caches(s);
    }
    if (!ok)
        return call_memory_error(s->loop.call, s->vertices / 4, error);
    return !s->probe_limit_reached || find_positions_by_sorting(s, error);
}
