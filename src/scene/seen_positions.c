// seen_positions.c: which vertices of a mesh lie where triangles lie that a picture shows.
//
// The vertices of those triangles go into a table by position. Then every vertex of the mesh is looked up in
// it. Vertices that are not seen are turned away by a small table of single bits before the large one is
// asked. Threads share both tables; that they insert in any order shows only in where things lie, never in a
// normal.
#include "seen_positions.h"

#include "weld.h"

#include <string.h>

enum { WORDS = 1 << 10 }; // of a set, in one piece of work

void number_set_count(struct number_set *set)
{
    uint32_t count = 0;
    for (size_t i = 0; i < number_set_words(set->size); i++) {
        set->before[i] = count;
        count += count_bits(set->bits[i]);
    }
    set->count = count;
}

void *seeing_take(struct seeing *s, struct arena *arena, size_t count, size_t size)
{
    size_t bytes, used = __atomic_load_n(&s->spare.used, __ATOMIC_RELAXED);
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 4)
        return NULL;
    size_t whole = (bytes + 63) / 64 * 64;
    while (whole <= s->spare.room - used)
        if (__atomic_compare_exchange_n(&s->spare.used, &used, used + whole, false, __ATOMIC_RELAXED,
                                        __ATOMIC_RELAXED))
            return (char *)s->spare.memory + used;
    return arena_alloc(arena, bytes);
}

void *seeing_take_zeroed(struct seeing *s, size_t bytes)
{
    void *memory = seeing_take(s, &s->scratch, bytes, 1);
    if (memory)
        memset(memory, 0, bytes);
    return memory;
}

// --- shown vertices

static void show_words(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    if (!goes_on(&s->halt))
        return;
    size_t last = s->first + (size_t)s->mesh->triangle_count; // not among them
    size_t first_word = s->first / 64, words = number_set_words(last) - first_word;
    for (size_t w = index * WORDS; w < piece_end(index, words, WORDS); w++) {
        size_t from = 64 * (first_word + w);
        for (uint64_t bits = s->seen->triangles.bits[first_word + w]; bits; bits &= bits - 1) {
            size_t number = from + (size_t)__builtin_ctzll(bits);
            if (number < s->first || number >= last)
                continue;
            for (size_t k = 0; k < 3; k++)
                number_set_add(&s->shown, corner_vertex(s->mesh, 3 * (number - s->first) + k));
        }
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
    size_t last = s->first + (size_t)s->mesh->triangle_count;
    pool_run(s->pool, pieces_of(number_set_words(last) - s->first / 64, WORDS), show_words, s);
    number_set_count(&s->shown);
    return true;
}

// --- the table

static const float *point_of(const struct seeing *s, size_t vertex)
{
    return s->mesh->positions + 3 * vertex;
}

static bool same_position(const struct seeing *s, uint32_t a, uint32_t b)
{
    // Floats compare as the bits do once −0 is 0, since none is NaN.
    const float *p = point_of(s, a), *q = point_of(s, b);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static uint64_t vertex_hash(const struct seeing *s, size_t vertex)
{
    uint32_t bits[3];
    position_bits(point_of(s, vertex), bits);
    return position_hash(bits);
}

// Asks memory for what a slot's vertex will be compared by.
static inline void prefetch_held(const struct seeing *s, uint32_t held)
{
    if (held != NONE)
        __builtin_prefetch(point_of(s, held));
}

// Inserts a vertex, or lowers the one at its position. Returns the steps beyond the first slot.
static size_t insert(struct seeing *s, uint32_t vertex, uint64_t hash)
{
    size_t steps = 0, bit = hash >> s->filter.shift;
    uint32_t *word = &s->filter_bits[bit / 32];
    if (!(__atomic_load_n(word, __ATOMIC_RELAXED) >> bit % 32 & 1))
        __atomic_fetch_or(word, (uint32_t)1 << bit % 32, __ATOMIC_RELAXED);
    for (size_t i = hash & s->slot_mask;; i = (i + 1) & s->slot_mask, steps++) {
        uint32_t held = __atomic_load_n(&s->slots[i], __ATOMIC_RELAXED);
        if (held == NONE && __atomic_compare_exchange_n(&s->slots[i], &held, vertex, false, __ATOMIC_RELAXED,
                                                        __ATOMIC_RELAXED))
            return steps;
        if (!same_position(s, held, vertex))
            continue;
        while (vertex < held && !__atomic_compare_exchange_n(&s->slots[i], &held, vertex, false,
                                                             __ATOMIC_RELAXED, __ATOMIC_RELAXED))
            ;
        return steps;
    }
}

// The next BATCH or fewer shown vertices from word *w, bit by bit, on.
static uint32_t next_shown(const struct seeing *s, size_t *w, size_t end, uint64_t *left, uint32_t out[BATCH])
{
    uint32_t count = 0;
    while (count < BATCH) {
        if (!*left) {
            if (++*w >= end)
                break;
            *left = s->shown.bits[*w];
            continue;
        }
        out[count++] = (uint32_t)(64 * *w + (size_t)__builtin_ctzll(*left));
        *left &= *left - 1;
    }
    return count;
}

bool few_steps(struct seeing *s, size_t steps, size_t total)
{
    if (steps > 16 * total + 4096)
        __atomic_store_n(&s->crowded, 1, __ATOMIC_RELAXED);
    return !__atomic_load_n(&s->crowded, __ATOMIC_RELAXED);
}

static void insert_words(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    if (!goes_on(&s->halt))
        return;
    size_t w = index * WORDS, end = piece_end(index, number_set_words(s->vertices), WORDS), steps = 0,
           total = 0;
    uint64_t left = s->shown.bits[w];
    uint32_t vertices[BATCH], count;
    while ((count = next_shown(s, &w, end, &left, vertices)) > 0) {
        uint64_t hashes[BATCH];
        for (uint32_t i = 0; i < count; i++) {
            hashes[i] = vertex_hash(s, vertices[i]);
            __builtin_prefetch(&s->slots[hashes[i] & s->slot_mask]);
        }
        for (uint32_t i = 0; i < count; i++)
            prefetch_held(s, __atomic_load_n(&s->slots[hashes[i] & s->slot_mask], __ATOMIC_RELAXED));
        for (uint32_t i = 0; i < count; i++)
            steps += insert(s, vertices[i], hashes[i]);
        total += count;
        if (!few_steps(s, steps, total))
            return;
    }
}

static bool fill_table(struct seeing *s)
{
    size_t slots = 1 << 10, bits = 1 << 12;
    s->filter.shift = 64 - 12;
    while (slots < 2 * (size_t)s->shown.count)
        slots *= 2;
    while (bits < 8 * (size_t)s->shown.count) {
        bits *= 2;
        s->filter.shift--;
    }
    s->slot_mask = slots - 1;
    s->slots = seeing_take(s, &s->scratch, slots, sizeof *s->slots);
    s->filter.bits = s->filter_bits = seeing_take_zeroed(s, bits / 8);
    if (!s->slots || !s->filter_bits)
        return false;
    memset(s->slots, 0xff, slots * sizeof *s->slots);
    pool_run(s->pool, pieces_of(number_set_words(s->vertices), WORDS), insert_words, s);
    return true;
}

size_t look_up(const struct seeing *s, size_t first, size_t count, uint32_t out[BATCH])
{
    uint64_t hashes[BATCH];
    uint32_t has[BATCH], passed[BATCH], passing = 0;
    size_t steps = 0;
    s->lanes->ask(point_of(s, first), count, &s->filter, hashes, has);
    for (uint32_t i = 0; i < count; i++) {
        out[i] = NONE;
        passed[passing] = i;
        passing += has[i];
    }
    for (uint32_t k = 0; k < passing; k++)
        __builtin_prefetch(&s->slots[hashes[passed[k]] & s->slot_mask]);
    for (uint32_t k = 0; k < passing; k++)
        prefetch_held(s, s->slots[hashes[passed[k]] & s->slot_mask]);
    for (uint32_t k = 0; k < passing; k++) {
        uint32_t i = passed[k], vertex = (uint32_t)(first + i), held;
        for (size_t at = hashes[i] & s->slot_mask;; at = (at + 1) & s->slot_mask) {
            held = s->slots[at];
            if (held == NONE || held == vertex || same_position(s, held, vertex))
                break;
            steps++;
        }
        if (held != NONE)
            out[i] = number_set_place(&s->shown, held);
    }
    return steps;
}

static void place_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    if (!goes_on(&s->halt))
        return;
    size_t end = piece_end(index, s->vertices, CHUNK), steps = 0;
    for (size_t v = index * CHUNK; v < end && few_steps(s, steps, CHUNK); v += BATCH) {
        size_t count = end - v < BATCH ? end - v : BATCH;
        uint32_t found[BATCH];
        steps += look_up(s, v, count, found);
        memcpy(s->position_of + v, found, count * sizeof *found);
    }
}

bool weld_all(struct seeing *s, lam_error *error)
{
    uint32_t positions;
    s->position_of = seeing_take(s, &s->scratch, s->vertices, sizeof *s->position_of);
    if (!s->position_of)
        return watch_memory_error(s->halt.watch, s->vertices * 4, error);
    if (!weld_positions(s->mesh->positions, s->vertices, s->position_of, &positions, s->pool, s->halt.watch,
                        error))
        return false;
    uint8_t *shown = seeing_take_zeroed(s, positions);
    if (!shown)
        return watch_memory_error(s->halt.watch, positions, error);
    for (size_t v = 0; v < s->vertices; v++)
        shown[s->position_of[v]] |= number_set_holds(&s->shown, v);
    for (size_t v = 0; v < s->vertices; v++)
        if (!shown[s->position_of[v]])
            s->position_of[v] = NONE;
    s->positions = positions;
    return true;
}

bool find_positions(struct seeing *s, lam_error *error)
{
    if (!find_shown(s) || !fill_table(s))
        return watch_memory_error(s->halt.watch, s->vertices / 4, error);
    s->positions = s->shown.count;
    if (s->mesh->indices && !s->crowded) {
        s->position_of = seeing_take(s, &s->scratch, s->vertices, sizeof *s->position_of);
        if (!s->position_of)
            return watch_memory_error(s->halt.watch, s->vertices * 4, error);
        pool_run(s->pool, pieces_of(s->vertices, CHUNK), place_chunk, s);
    }
    return !s->crowded || weld_all(s, error);
}
