// shared_positions.c: which vertices of a mesh lie where triangles lie that a picture shows.
//
// The vertices of those triangles go into a table by position. Then every other vertex of the mesh is looked
// up in it; most are turned away by a small table of bits before the large one is asked. In what order
// threads come shows only in where things lie, never in a normal.
#include "shared_positions.h"

#include "weld.h"

#include <string.h>

enum {
    WORDS = 1 << 8,        // of a set, in one piece of work
    AHEAD = 16,            // words whose triangles' positions memory is asked for early
    TOGETHER = 8,          // words whose vertices wait for the table together
    SLAB = 2 << 20,        // of blocks
    ANSWERS_MAX = 1 << 13, // that a thread keeps: they fit the second-level cache
};

void number_set_count(struct number_set *set)
{
    uint32_t count = 0;
    for (size_t i = 0; i < number_set_words(set->size); i++) {
        set->before[i] = count;
        count += count_bits(set->bits[i]);
    }
    set->count = count;
}

// What is done with before any fan is made may lie where normals will.
static void *take_until_fans(struct seeing *s, size_t count, size_t size)
{
    for (int i = 0; i < 2; i++) {
        struct spare *there = &s->until_fans[i];
        if (count <= (there->room - there->used) / size / 64 * 64)
            return spare_take(there, &s->scratch, count, size);
    }
    return seeing_take(s, &s->scratch, count, size);
}

void *seeing_take_zeroed(struct seeing *s, size_t bytes)
{
    void *memory = seeing_take(s, &s->scratch, bytes, 1);
    if (memory)
        memset(memory, 0, bytes);
    return memory;
}

bool few_steps(struct seeing *s, size_t steps, size_t total)
{
    if (steps > 16 * total + 4096)
        __atomic_store_n(&s->crowded, 1, __ATOMIC_RELAXED);
    return !__atomic_load_n(&s->crowded, __ATOMIC_RELAXED);
}

// --- the triangles that are seen

static size_t first_word(const struct seeing *s) { return s->first / 64; }

static size_t triangle_words(const struct seeing *s)
{
    return number_set_words(s->first + (size_t)s->mesh->triangle_count) - first_word(s);
}

// Those of the mesh in a word of the set.
static uint64_t seen_word(const struct seeing *s, size_t word)
{
    size_t from = 64 * word, last = s->first + (size_t)s->mesh->triangle_count;
    uint64_t bits = s->seen->triangles.bits[word];
    if (from < s->first)
        bits &= ~UINT64_C(0) << (s->first - from);
    if (from + 64 > last)
        bits &= ~UINT64_C(0) >> (from + 64 - last);
    return bits;
}

static void show_words(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    if (!should_continue(&s->loop))
        return;
    for (size_t w = index * WORDS; w < piece_end(index, triangle_words(s), WORDS); w++)
        for (uint64_t bits = seen_word(s, first_word(s) + w); bits; bits &= bits - 1) {
            size_t triangle = 64 * (first_word(s) + w) + (size_t)__builtin_ctzll(bits) - s->first;
            for (size_t k = 0; k < 3; k++)
                number_set_add(&s->shown, s->mesh->indices[3 * triangle + k]);
        }
}

static bool find_shown(struct seeing *s)
{
    size_t words = number_set_words(s->vertices);
    s->shown.size = s->vertices;
    s->shown.bits = seeing_take_zeroed(s, words * sizeof *s->shown.bits);
    s->shown.before = seeing_take(s, &s->scratch, words, sizeof *s->shown.before);
    if (!s->shown.bits || !s->shown.before)
        return false;
    pool_run(s->pool, pieces_of(triangle_words(s), WORDS), show_words, s);
    number_set_count(&s->shown);
    return true;
}

// --- the table

// Puts a vertex into its part's bin, unless a vertex at its position was lately.
static inline bool spread(struct seeing *s, int thread, size_t vertex)
{
    struct seen_lists *lists = &s->lists[thread];
    uint32_t bits[3];
    position_bits(point_of(s, vertex), bits);
    uint32_t hash = seen_hash(bits);
    if (s->answers) {
        struct seen_answer *lately = &s->answers[thread][hash & s->answers_mask];
        if (same_bits(lately->bits, bits))
            return true;
        copy_bits(lately->bits, bits);
    }
    struct seen_block *block = seen_block_for_one(lists, &lists->bins[seen_table_part(&s->table, hash)], BLOCK_KEYS);
    if (!block)
        return false;
    struct seen_key *key = &block->key[block->count++];
    copy_bits(key->bits, bits);
    key->vertex = (uint32_t)vertex;
    return true;
}

static void spread_vertices(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!should_continue(&s->loop))
        return;
    for (size_t w = index * WORDS; w < piece_end(index, number_set_words(s->vertices), WORDS); w++)
        for (uint64_t bits = s->shown.bits[w]; bits; bits &= bits - 1)
            if (!spread(s, thread, 64 * w + (size_t)__builtin_ctzll(bits)))
                return;
}

static void spread_corners(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!should_continue(&s->loop))
        return;
    size_t end = piece_end(index, triangle_words(s), WORDS);
    for (size_t w = index * WORDS, ahead = w; w < end; w++) {
        for (; ahead < end && ahead < w + AHEAD; ahead++)
            for (uint64_t bits = seen_word(s, first_word(s) + ahead); bits; bits &= bits - 1) {
                size_t triangle = 64 * (first_word(s) + ahead) + (size_t)__builtin_ctzll(bits) - s->first;
                __builtin_prefetch(point_of(s, 3 * triangle));
                __builtin_prefetch(point_of(s, 3 * triangle + 2) + 2);
            }
        for (uint64_t bits = seen_word(s, first_word(s) + w); bits; bits &= bits - 1) {
            size_t triangle = 64 * (first_word(s) + w) + (size_t)__builtin_ctzll(bits) - s->first;
            for (size_t k = 0; k < 3; k++)
                if (!spread(s, thread, 3 * triangle + k))
                    return;
        }
    }
}

static void fill_part(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (should_continue(&s->loop) && !seen_table_fill(&s->table, (uint32_t)index, s->lists, pool_threads(s->pool),
                                                      &s->lists[thread], s->mesh->indices != NULL))
        __atomic_store_n(&s->crowded, 1, __ATOMIC_RELAXED);
}

static bool start_lists(struct seeing *s)
{
    size_t threads = (size_t)pool_threads(s->pool);
    // Blocks for a small model come in small slabs.
    size_t slab = SLAB;
    while (slab > 16 * BLOCK_BYTES && slab / 2 > s->corners * 8)
        slab /= 2;
    s->lists = seeing_take_zeroed(s, threads * sizeof *s->lists);
    for (size_t i = 0; s->lists && i < threads; i++) {
        struct seen_lists *lists = &s->lists[i];
        *lists = (struct seen_lists){.spare = &s->spare, .loop = &s->loop, .slab_bytes = slab};
        arena_start(&lists->arena, s->loop.call);
        lists->bins = seeing_take_zeroed(s, (size_t)seen_table_parts(&s->table) * sizeof *lists->bins);
        if (!lists->bins)
            return false;
    }
    return s->lists != NULL;
}

void stop_lists(struct seeing *s)
{
    for (int i = 0; s->lists && i < pool_threads(s->pool); i++)
        arena_free(&s->lists[i].arena);
    s->lists = NULL;
}

// No position's bits are all ones.
static void forget_answers(struct seeing *s)
{
    for (int i = 0; i < pool_threads(s->pool); i++)
        memset(s->answers[i], 0xff, (s->answers_mask + (size_t)1) * sizeof **s->answers);
}

// Without indices the same positions come again and again, mostly soon.
static bool start_answers(struct seeing *s)
{
    size_t threads = (size_t)pool_threads(s->pool), room = 64;
    while (room < ANSWERS_MAX && room < s->corners / 4)
        room *= 2;
    s->answers_mask = (uint32_t)room - 1;
    s->answers = seeing_take(s, &s->scratch, threads, sizeof *s->answers);
    if (!s->answers)
        return false;
    for (size_t i = 0; i < threads; i++) {
        s->answers[i] = seeing_take(s, &s->scratch, room, sizeof **s->answers);
        if (!s->answers[i])
            return false;
    }
    forget_answers(s);
    return true;
}

static size_t keys_of(const struct seeing *s)
{
    size_t keys = 0;
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (uint32_t p = 0; p < seen_table_parts(&s->table); p++)
            for (const struct seen_block *block = s->lists[t].bins[p]; block; block = block->before)
                keys += block->count;
    return keys;
}

static bool fill_table(struct seeing *s)
{
    const bool indexed = s->mesh->indices != NULL;
    size_t shown = indexed ? s->shown.count : 3 * (size_t)seen_triangles_before(s, s->mesh->triangle_count);
    s->positions = shown;
    seen_table_plan(&s->table, shown);
    if (!start_lists(s) || (!indexed && !start_answers(s)))
        return false;
    if (indexed)
        pool_run(s->pool, pieces_of(number_set_words(s->vertices), WORDS), spread_vertices, s);
    else
        pool_run(s->pool, pieces_of(triangle_words(s), WORDS), spread_corners, s);
    size_t bytes = seen_table_size(&s->table, keys_of(s), indexed);
    void *memory = spare_lend(&s->spare, bytes);
    if (!memory)
        memory = take_until_fans(s, bytes, 1);
    if (!memory)
        return false;
    seen_table_place(&s->table, memory);
    pool_run(s->pool, seen_table_parts(&s->table), fill_part, s);
    return true;
}

// --- the other vertices of a mesh with indices

// Numbers the shown vertices of some words of the set, and asks the table for those of the others that pass
// the filter, which are few.
static size_t place_some(const struct seeing *s, size_t word, size_t end)
{
    uint32_t asked[WORD * TOGETHER], hash[WORD * TOGETHER], asking = 0;
    for (; word < end; word++) {
        size_t first = WORD * word, count = s->vertices - first < WORD ? s->vertices - first : WORD;
        uint64_t shown = s->shown.bits[word];
        uint32_t hashes[WORD];
        s->search->number(shown, s->shown.before[word], s->position_of + first);
        uint64_t passed = s->search->ask(point_of(s, first), (uint32_t)count, &s->table.filter, hashes) & ~shown;
        for (; passed; passed &= passed - 1) {
            uint32_t i = (uint32_t)__builtin_ctzll(passed);
            __builtin_prefetch(&s->table.lines[seen_table_start(&s->table, hashes[i])]);
            asked[asking] = (uint32_t)first + i;
            hash[asking++] = hashes[i];
        }
    }
    size_t steps = 0;
    for (uint32_t k = 0; k < asking; k++) {
        uint32_t bits[3];
        position_bits(point_of(s, asked[k]), bits);
        uint32_t vertex = seen_table_find(&s->table, bits, hash[k], &steps);
        if (vertex != NONE)
            s->position_of[asked[k]] = number_set_place(&s->shown, vertex);
    }
    return steps;
}

static void place_words(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    if (!should_continue(&s->loop))
        return;
    size_t steps = 0, end = piece_end(index, number_set_words(s->vertices), WORDS);
    for (size_t w = index * WORDS; w < end && few_steps(s, steps, WORD * WORDS); w += TOGETHER)
        steps += place_some(s, w, w + TOGETHER < end ? w + TOGETHER : end);
}

// Those shown vertices where another one stands for the position.
static void place_doubles(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    for (const struct seen_block *block = s->lists[index].doubles; block; block = block->before)
        for (uint32_t i = 0; i < block->count; i++)
            s->position_of[block->doubles[i][0]] = number_set_place(&s->shown, block->doubles[i][1]);
    seen_blocks_reuse(&s->lists[index], &s->lists[index].doubles);
}

static bool place_vertices(struct seeing *s)
{
    s->position_of = take_until_fans(s, WORD * number_set_words(s->vertices), sizeof *s->position_of);
    if (!s->position_of)
        return false;
    pool_run(s->pool, pieces_of(number_set_words(s->vertices), WORDS), place_words, s);
    pool_run(s->pool, (size_t)pool_threads(s->pool), place_doubles, s);
    return true;
}

// --- all

bool weld_all(struct seeing *s, lam_error *error)
{
    uint32_t positions;
    if (!s->position_of)
        s->position_of = seeing_take(s, &s->scratch, s->vertices, sizeof *s->position_of);
    if (!s->position_of)
        return call_memory_error(s->loop.call, s->vertices * 4, error);
    if (!weld_positions(s->mesh->positions, s->vertices, s->position_of, &positions, s->pool, s->loop.call, error))
        return false;
    uint8_t *shown = seeing_take_zeroed(s, positions);
    if (!shown)
        return call_memory_error(s->loop.call, positions, error);
    for (size_t w = 0; w < triangle_words(s); w++)
        for (uint64_t bits = seen_word(s, first_word(s) + w); bits; bits &= bits - 1) {
            size_t triangle = 64 * (first_word(s) + w) + (size_t)__builtin_ctzll(bits) - s->first;
            for (size_t k = 0; k < 3; k++)
                shown[s->position_of[corner_vertex(s->mesh, 3 * triangle + k)]] = 1;
        }
    for (size_t v = 0; v < s->vertices; v++)
        if (!shown[s->position_of[v]])
            s->position_of[v] = NONE;
    s->positions = positions;
    return true;
}

bool find_positions(struct seeing *s, lam_error *error)
{
    const bool indexed = s->mesh->indices != NULL;
    bool ok = (!indexed || find_shown(s)) && fill_table(s);
    if (ok && indexed && !s->crowded) {
        ok = place_vertices(s);
        spare_give_back(&s->spare); // the table is done with
    } else if (ok && !indexed) {
        forget_answers(s);
    }
    if (!ok)
        return call_memory_error(s->loop.call, s->vertices / 4, error);
    return !s->crowded || weld_all(s, error);
}
