// weld.c: which vertices share a position.
//
// Vertices are spread over partitions by a hash of their position, and each partition finds its equal ones in
// a table that fits the second-level cache. Both steps run in parallel; the result does not depend on it.
#include "weld.h"

#include "arena.h"

#include <stdlib.h>
#include <string.h>

enum {
    CHUNK = 1 << 16, // vertices of one piece of work, at least
    CHUNKS_MAX = 1 << 10,
    PARTITION = 1 << 14, // vertices aimed at in a partition
    PARTITIONS_MAX = 1 << 12,
};

#define NO_VERTEX UINT32_MAX

struct weld_slot {
    uint32_t position[3];
    uint32_t vertex; // lowest of its position; NO_VERTEX: free
};

struct weld_table {
    struct weld_slot *slots;
    size_t room; // slots there is memory for
};

struct welding {
    const float *points;
    size_t vertices;
    uint32_t *position_of;
    uint32_t positions;
    struct pool *pool;
    struct loop_status loop;

    size_t chunks, chunk;
    unsigned partitions, partition_shift;
    uint32_t *starts;          // [chunk][partition]: first counts, then places in `spread`
    uint32_t *spread;          // vertices by partition, ascending in each
    struct weld_table *tables; // one for each thread
    struct arena *thread_arenas;
};

static uint64_t vertex_hash(const struct welding *w, size_t vertex, uint32_t bits[3])
{
    position_bits(w->points + 3 * vertex, bits);
    return position_hash(bits);
}

static size_t chunk_end(const struct welding *w, size_t index)
{
    size_t end = (index + 1) * w->chunk;
    return end < w->vertices ? end : w->vertices;
}

static void count_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct welding *w = user;
    if (!should_continue(&w->loop))
        return;
    uint32_t *counts = w->starts + index * w->partitions, bits[3];
    memset(counts, 0, w->partitions * sizeof *counts);
    for (size_t v = index * w->chunk; v < chunk_end(w, index); v++)
        counts[vertex_hash(w, v, bits) >> w->partition_shift]++;
}

static void spread_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct welding *w = user;
    if (!should_continue(&w->loop))
        return;
    uint32_t *places = w->starts + index * w->partitions, bits[3];
    for (size_t v = index * w->chunk; v < chunk_end(w, index); v++)
        w->spread[places[vertex_hash(w, v, bits) >> w->partition_shift]++] = (uint32_t)v;
}

static struct weld_slot *find_slot(struct weld_slot *slots, size_t mask, uint64_t hash, const uint32_t bits[3],
                                   size_t *steps)
{
    for (size_t i = hash & mask;; i = (i + 1) & mask) {
        struct weld_slot *slot = &slots[i];
        if (slot->vertex == NO_VERTEX || memcmp(slot->position, bits, sizeof slot->position) == 0)
            return slot;
        ++*steps;
    }
}

// A fresh table of `room` slots, all free; a smaller one before it is left to the arena.
static bool table_clear(struct weld_table *table, struct arena *arena, size_t room)
{
    if (room > table->room) {
        table->slots = arena_array(arena, room, sizeof *table->slots);
        table->room = table->slots ? room : 0;
    }
    if (table->slots)
        memset(table->slots, 0xff, room * sizeof *table->slots);
    return table->slots != NULL;
}

// Doubles a table of which `room` slots are in use.
static bool table_double(struct weld_table *table, struct arena *arena, size_t room)
{
    const struct weld_slot *old = table->slots;
    table->room = 0; // so that the old slots stay
    if (!table_clear(table, arena, 2 * room))
        return false;
    size_t steps = 0;
    for (size_t i = 0; i < room; i++)
        if (old[i].vertex != NO_VERTEX)
            *find_slot(table->slots, 2 * room - 1, position_hash(old[i].position), old[i].position, &steps) = old[i];
    return true;
}

// A file may have been made so that all its positions fall into few slots. Then the partition is sorted instead.
struct sorted_vertex {
    uint32_t position[3], vertex;
};

static int compare_vertices(const void *left, const void *right)
{
    const struct sorted_vertex *a = left, *b = right;
    int order = memcmp(a->position, b->position, sizeof a->position);
    return order ? order : a->vertex < b->vertex ? -1 : 1;
}

static void weld_by_sorting(struct welding *w, const uint32_t *vertices, size_t count)
{
    struct arena scratch;
    arena_start(&scratch, w->loop.call);
    struct sorted_vertex *sorted = arena_array(&scratch, count, sizeof *sorted);
    if (!sorted) {
        no_memory(&w->loop);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        sorted[i].vertex = vertices[i];
        position_bits(w->points + 3 * (size_t)vertices[i], sorted[i].position);
    }
    qsort(sorted, count, sizeof *sorted, compare_vertices);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (memcmp(sorted[i].position, sorted[first].position, sizeof sorted[i].position) != 0)
            first = i;
        w->position_of[sorted[i].vertex] = sorted[first].vertex;
    }
    arena_free(&scratch);
}

static void weld_partition(void *user, size_t index, int thread)
{
    enum { AHEAD = 16 };
    struct welding *w = user;
    if (!should_continue(&w->loop))
        return;
    // After spreading, a partition's place in the last chunk is its end, which is where the next one begins.
    const uint32_t *ends = w->starts + (w->chunks - 1) * w->partitions;
    size_t first = index ? ends[index - 1] : 0, count = ends[index] - first;
    const uint32_t *vertices = w->spread + first;
    struct weld_table *table = &w->tables[thread];
    struct arena *arena = &w->thread_arenas[thread];
    // Room for what falls into a partition by chance; one that a file has filled on purpose starts so too and
    // grows, since most of its vertices may be equal.
    size_t room = 1024, used = 0, steps = 0, usual = w->vertices / w->partitions;
    while (room < 2 * count && room < 4 * usual)
        room *= 2;
    if (!table_clear(table, arena, room)) {
        no_memory(&w->loop);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        if (i + AHEAD < count)
            __builtin_prefetch(w->points + 3 * (size_t)vertices[i + AHEAD]);
        if (2 * used >= room) {
            if (!should_continue(&w->loop))
                return;
            if (!table_double(table, arena, room)) {
                no_memory(&w->loop);
                return;
            }
            room *= 2;
        }
        uint32_t bits[3];
        uint64_t hash = vertex_hash(w, vertices[i], bits);
        struct weld_slot *slot = find_slot(table->slots, room - 1, hash, bits, &steps);
        if (slot->vertex == NO_VERTEX) {
            memcpy(slot->position, bits, sizeof bits);
            slot->vertex = vertices[i];
            used++;
        }
        w->position_of[vertices[i]] = slot->vertex;
        if (steps > 16 * count + 4096) {
            weld_by_sorting(w, vertices, count);
            return;
        }
    }
}

// Turns counts into places: partition by partition, in each chunk by chunk.
static void place_partitions(struct welding *w)
{
    uint32_t place = 0;
    for (unsigned p = 0; p < w->partitions; p++)
        for (size_t c = 0; c < w->chunks; c++) {
            uint32_t *at = &w->starts[c * w->partitions + p], count = *at;
            *at = place;
            place += count;
        }
}

// From the lowest vertex of each position to numbers without gaps. A lowest vertex comes before the others of
// its position, so it has its number when they ask for it.
static void number_positions(struct welding *w)
{
    for (size_t v = 0; v < w->vertices; v++) {
        uint32_t lowest = w->position_of[v];
        w->position_of[v] = lowest == v ? w->positions++ : w->position_of[lowest];
    }
}

static void cut(struct welding *w)
{
    w->chunk = CHUNK;
    while (w->vertices / w->chunk > CHUNKS_MAX)
        w->chunk *= 2;
    w->chunks = (w->vertices + w->chunk - 1) / w->chunk;
    w->partitions = 2;
    w->partition_shift = 63; // the hash's upper bits choose the partition, the lower ones the slot
    while (w->partitions < PARTITIONS_MAX && w->vertices / w->partitions > PARTITION) {
        w->partitions *= 2;
        w->partition_shift--;
    }
}

bool weld_positions(const float *points, size_t count, uint32_t *position_of, uint32_t *positions, struct pool *pool,
                    struct call_control *call, lam_error *error)
{
    struct welding welding = {
        .points = points, .vertices = count, .position_of = position_of, .pool = pool, .loop = {.call = call}};
    struct welding *w = &welding;
    *positions = 0;
    if (count == 0)
        return true;
    cut(w);
    size_t threads = (size_t)pool_threads(pool);
    struct arena scratch;
    arena_start(&scratch, call);
    w->starts = arena_array(&scratch, w->chunks * w->partitions, sizeof *w->starts);
    w->spread = arena_array(&scratch, count, sizeof *w->spread);
    w->tables = arena_alloc_zeroed(&scratch, threads * sizeof *w->tables);
    w->thread_arenas = arena_array(&scratch, threads, sizeof *w->thread_arenas);
    if (!w->starts || !w->spread || !w->tables || !w->thread_arenas)
        no_memory(&w->loop);
    if (should_continue(&w->loop)) {
        for (size_t i = 0; i < threads; i++)
            arena_start(&w->thread_arenas[i], call);
        pool_run(pool, w->chunks, count_chunk, w);
        place_partitions(w);
        pool_run(pool, w->chunks, spread_chunk, w);
        pool_run(pool, w->partitions, weld_partition, w);
        for (size_t i = 0; i < threads; i++)
            arena_free(&w->thread_arenas[i]);
    }
    arena_free(&scratch);
    if (!should_continue(&w->loop))
        return loop_error(&w->loop, count * 8, error);
    number_positions(w);
    *positions = w->positions;
    return true;
}
