// normals.c: normals for meshes that have none.
//
// Smooth normals, in four steps over the whole mesh:
//   1. weld: vertices are spread over partitions by a hash of their position, and each partition finds its
//   equal ones in a
//      table that fits the second-level cache. A position is then a number, in the order of its lowest
//      vertex.
//   2. link: each corner is pushed onto its position's list (one exchange of a list head, so any number of
//   threads may).
//      The links lie in the array that becomes normal_indices, which is what keeps 10 million triangles in
//      some hundred MB.
//   3. fans: for each position the corners are put in order and normals_fan.c works out the normals, in
//   pieces of a fixed
//      number of positions; a corner's index counts within its piece.
//   4. shift: the pieces' normals are strung together, and each corner's index moved by those before its
//   piece.
// The lists' order is the only thing that depends on the threads, and step 3 sorts it away.
#include "normals.h"

#include "fail.h"
#include "linear.h"
#include "normals_fan.h"

#include <stdlib.h>
#include <string.h>

enum {
    CHUNK = 1 << 16,     // vertices or corners of one piece of work
    PARTITION = 1 << 14, // vertices aimed at in a partition
    PARTITIONS_MAX = 1 << 12,
    PIECE = 1 << 12, // positions of one piece of work
};

// Positions are floats: one and the same angle, computed from two of its sides, differs in the seventh digit.
#define CREASE_SLACK 1e-6

struct weld_slot {
    uint32_t position[3];
    uint32_t vertex; // lowest of its position; NO_VERTEX: free
};
#define NO_VERTEX UINT32_MAX

struct weld_table {
    struct weld_slot *slots;
    size_t room; // slots there is memory for
};

// The normals of one piece, in the arena of the thread that made them.
struct piece {
    float (*normals)[3];
    uint32_t count, before; // before: normals of all pieces before this one
};

struct smoothing {
    lam_mesh *mesh;
    double least_cosine;
    struct arena *scratch;
    struct pool *pool;
    struct watch *watch;
    int stopped, out_of_memory; // set by any thread
    size_t vertices, corners;
    uint32_t *position_of; // vertex → number of its position
    uint32_t positions;

    // welding
    size_t chunks, chunk;
    unsigned partitions, partition_shift;
    uint32_t *starts;          // [chunk][partition]: first counts, then places in `spread`
    uint32_t *spread;          // vertices by partition, ascending in each
    struct weld_table *tables; // one for each thread
    struct arena *thread_arenas;

    uint32_t *heads;        // position → its last pushed corner
    uint32_t *indices;      // corner → the corner pushed before it; then its normal's index
    struct fan_room *rooms; // one for each thread
    struct piece *pieces;
    float (*normals)[3];
    uint32_t normal_count;
};

static bool goes_on(struct smoothing *s)
{
    if (__atomic_load_n(&s->stopped, __ATOMIC_RELAXED) ||
        __atomic_load_n(&s->out_of_memory, __ATOMIC_RELAXED))
        return false;
    if (watch_on(s->watch))
        return true;
    __atomic_store_n(&s->stopped, 1, __ATOMIC_RELAXED);
    return false;
}

static void no_memory(struct smoothing *s)
{
    __atomic_store_n(&s->out_of_memory, 1, __ATOMIC_RELAXED);
}

// --- 1. Weld

static uint64_t hash_of(const uint32_t bits[3])
{
    uint64_t h = (bits[0] | (uint64_t)bits[1] << 32) * UINT64_C(0x9e3779b97f4a7c15);
    h = (h ^ h >> 32 ^ bits[2]) * UINT64_C(0xd6e8feb86659fd93);
    return h ^ h >> 32;
}

static uint64_t vertex_hash(const struct smoothing *s, size_t vertex, uint32_t bits[3])
{
    position_bits(s->mesh->positions + 3 * vertex, bits);
    return hash_of(bits);
}

static size_t chunk_end(const struct smoothing *s, size_t index, size_t total)
{
    size_t end = (index + 1) * s->chunk;
    return end < total ? end : total;
}

static void count_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    if (!goes_on(s))
        return;
    uint32_t *counts = s->starts + index * s->partitions, bits[3];
    memset(counts, 0, s->partitions * sizeof *counts);
    for (size_t v = index * s->chunk; v < chunk_end(s, index, s->vertices); v++)
        counts[vertex_hash(s, v, bits) >> s->partition_shift]++;
}

static void spread_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    if (!goes_on(s))
        return;
    uint32_t *places = s->starts + index * s->partitions, bits[3];
    for (size_t v = index * s->chunk; v < chunk_end(s, index, s->vertices); v++)
        s->spread[places[vertex_hash(s, v, bits) >> s->partition_shift]++] = (uint32_t)v;
}

static struct weld_slot *find_slot(struct weld_slot *slots, size_t mask, uint64_t hash,
                                   const uint32_t bits[3], size_t *steps)
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
            *find_slot(table->slots, 2 * room - 1, hash_of(old[i].position), old[i].position, &steps) =
                old[i];
    return true;
}

// A file may have been made so that all its positions fall into few slots. Then the partition is sorted
// instead.
struct sorted_vertex {
    uint32_t position[3], vertex;
};

static int compare_vertices(const void *left, const void *right)
{
    const struct sorted_vertex *a = left, *b = right;
    int order = memcmp(a->position, b->position, sizeof a->position);
    return order ? order : a->vertex < b->vertex ? -1 : 1;
}

static void weld_by_sorting(struct smoothing *s, const uint32_t *vertices, size_t count)
{
    struct arena scratch;
    arena_start(&scratch, s->watch);
    struct sorted_vertex *sorted = arena_array(&scratch, count, sizeof *sorted);
    if (!sorted) {
        no_memory(s);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        sorted[i].vertex = vertices[i];
        position_bits(s->mesh->positions + 3 * (size_t)vertices[i], sorted[i].position);
    }
    qsort(sorted, count, sizeof *sorted, compare_vertices);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (memcmp(sorted[i].position, sorted[first].position, sizeof sorted[i].position) != 0)
            first = i;
        s->position_of[sorted[i].vertex] = sorted[first].vertex;
    }
    arena_free(&scratch);
}

static void weld_partition(void *user, size_t index, int thread)
{
    enum { AHEAD = 16 };
    struct smoothing *s = user;
    if (!goes_on(s))
        return;
    // After spreading, a partition's place in the last chunk is its end, which is where the next one begins.
    const uint32_t *ends = s->starts + (s->chunks - 1) * s->partitions;
    size_t first = index ? ends[index - 1] : 0, count = ends[index] - first;
    const uint32_t *vertices = s->spread + first;
    struct weld_table *table = &s->tables[thread];
    struct arena *arena = &s->thread_arenas[thread];
    // Room for what falls into a partition by chance; one that a file has filled on purpose starts so too and
    // grows, since most of its vertices may be equal.
    size_t room = 1024, used = 0, steps = 0, usual = s->vertices / s->partitions;
    while (room < 2 * count && room < 4 * usual)
        room *= 2;
    if (!table_clear(table, arena, room)) {
        no_memory(s);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        if (i + AHEAD < count)
            __builtin_prefetch(s->mesh->positions + 3 * (size_t)vertices[i + AHEAD]);
        if (2 * used >= room) {
            if (!goes_on(s))
                return;
            if (!table_double(table, arena, room)) {
                no_memory(s);
                return;
            }
            room *= 2;
        }
        uint32_t bits[3];
        uint64_t hash = vertex_hash(s, vertices[i], bits);
        struct weld_slot *slot = find_slot(table->slots, room - 1, hash, bits, &steps);
        if (slot->vertex == NO_VERTEX) {
            memcpy(slot->position, bits, sizeof bits);
            slot->vertex = vertices[i];
            used++;
        }
        s->position_of[vertices[i]] = slot->vertex;
        if (steps > 16 * count + 4096) {
            weld_by_sorting(s, vertices, count);
            return;
        }
    }
}

// Turns counts into places: partition by partition, in each chunk by chunk.
static void place_partitions(struct smoothing *s)
{
    uint32_t place = 0;
    for (unsigned p = 0; p < s->partitions; p++)
        for (size_t c = 0; c < s->chunks; c++) {
            uint32_t *at = &s->starts[c * s->partitions + p], count = *at;
            *at = place;
            place += count;
        }
}

// From the lowest vertex of each position to numbers without gaps. A lowest vertex comes before the others of
// its position, so it has its number when they ask for it.
static void number_positions(struct smoothing *s)
{
    for (size_t v = 0; v < s->vertices; v++) {
        uint32_t lowest = s->position_of[v];
        s->position_of[v] = lowest == v ? s->positions++ : s->position_of[lowest];
    }
}

static bool weld(struct smoothing *s)
{
    if (s->vertices == 0)
        return true;
    int threads = pool_threads(s->pool);
    s->chunk = CHUNK;
    while (s->vertices / s->chunk > 1024)
        s->chunk *= 2;
    s->chunks = (s->vertices + s->chunk - 1) / s->chunk;
    s->partitions = 2;
    s->partition_shift = 63; // the hash's upper bits choose the partition, the lower ones the slot
    while (s->partitions < PARTITIONS_MAX && s->vertices / s->partitions > PARTITION) {
        s->partitions *= 2;
        s->partition_shift--;
    }
    struct arena scratch;
    arena_start(&scratch, s->watch);
    s->starts = arena_array(&scratch, s->chunks * s->partitions, sizeof *s->starts);
    s->spread = arena_array(&scratch, s->vertices, sizeof *s->spread);
    s->tables = arena_alloc_zeroed(&scratch, (size_t)threads * sizeof *s->tables);
    s->thread_arenas = arena_alloc_zeroed(&scratch, (size_t)threads * sizeof *s->thread_arenas);
    if (s->starts && s->spread && s->tables && s->thread_arenas) {
        for (int i = 0; i < threads; i++)
            arena_start(&s->thread_arenas[i], s->watch);
        pool_run(s->pool, s->chunks, count_chunk, s);
        if (goes_on(s)) {
            place_partitions(s);
            pool_run(s->pool, s->chunks, spread_chunk, s);
        }
        if (goes_on(s))
            pool_run(s->pool, s->partitions, weld_partition, s);
        for (int i = 0; i < threads; i++)
            arena_free(&s->thread_arenas[i]);
    } else
        no_memory(s);
    arena_free(&scratch);
    if (!goes_on(s))
        return false;
    number_positions(s);
    return true;
}

// --- 2. Link

#define NO_CORNER UINT32_MAX

static void link_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    if (!goes_on(s))
        return;
    for (size_t c = index * s->chunk; c < chunk_end(s, index, s->corners); c++) {
        uint32_t position = s->position_of[corner_vertex(s->mesh, c)];
        s->indices[c] = __atomic_exchange_n(&s->heads[position], (uint32_t)c, __ATOMIC_RELAXED);
    }
}

// --- 3. Fans

static int compare_corners(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

// The list was pushed in nearly ascending order, so it is read in nearly descending order.
static void sort_corners(uint32_t *corners, uint32_t count)
{
    for (uint32_t i = 0, j = count - 1; i < j; i++, j--) {
        uint32_t swap = corners[i];
        corners[i] = corners[j];
        corners[j] = swap;
    }
    if (count > 64) {
        bool sorted = true;
        for (uint32_t i = 1; i < count; i++)
            sorted &= corners[i - 1] < corners[i];
        if (!sorted)
            qsort(corners, count, sizeof *corners, compare_corners);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        uint32_t corner = corners[i], j = i;
        for (; j > 0 && corners[j - 1] > corner; j--)
            corners[j] = corners[j - 1];
        corners[j] = corner;
    }
}

// The corners of a position into room->corners. False when memory is out.
static bool gather(const struct smoothing *s, uint32_t position, struct fan_room *room, uint32_t *count)
{
    uint32_t n = 0;
    for (uint32_t c = s->heads[position]; c != NO_CORNER; c = s->indices[c]) {
        if (n == room->room && !fan_room_reserve(room, n + 1))
            return false;
        room->corners[n++] = c;
    }
    *count = n;
    if (n)
        sort_corners(room->corners, n);
    return true;
}

static void fan_piece(void *user, size_t index, int thread)
{
    struct smoothing *s = user;
    if (!goes_on(s))
        return;
    struct fan_room *room = &s->rooms[thread];
    struct piece *piece = &s->pieces[index];
    size_t first = index * PIECE, end = first + PIECE < s->positions ? first + PIECE : s->positions;
    struct arena *arena = &room->arena;
    uint32_t held = 0;
    float(*normals)[3] = NULL;
    for (size_t position = first; position < end; position++) {
        uint32_t count;
        if (!gather(s, (uint32_t)position, room, &count)) {
            no_memory(s);
            return;
        }
        uint32_t fans = count ? fan_normals(s->mesh, s->least_cosine, room, count) : 0;
        if (piece->count + fans > held) {
            // At first one normal for each position, which is most often what is needed.
            uint32_t larger = held ? 2 * held : (uint32_t)(end - first);
            larger = larger < piece->count + fans ? piece->count + fans : larger;
            float(*copy)[3] = arena_array(arena, larger, sizeof *copy);
            if (!copy) {
                no_memory(s);
                return;
            }
            if (piece->count)
                memcpy(copy, normals, piece->count * sizeof *copy);
            normals = copy;
            held = larger;
        }
        for (uint32_t i = 0; i < count; i++)
            s->indices[room->spokes[i].corner] = piece->count + room->spokes[i].fan;
        if (fans)
            memcpy(normals + piece->count, room->normals, fans * sizeof *normals);
        piece->count += fans;
    }
    piece->normals = normals;
}

// --- 4. Shift

static void shift_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    if (!goes_on(s))
        return;
    for (size_t c = index * s->chunk; c < chunk_end(s, index, s->corners); c++)
        s->indices[c] += s->pieces[s->position_of[corner_vertex(s->mesh, c)] / PIECE].before;
}

static void copy_piece(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    const struct piece *piece = &s->pieces[index];
    if (piece->count)
        memcpy(s->normals + piece->before, piece->normals, piece->count * sizeof *s->normals);
}

// Steps 3 and 4, with the normals in `arena`.
static bool make_fans(struct smoothing *s, struct arena *arena)
{
    int threads = pool_threads(s->pool);
    size_t pieces = (s->positions + (size_t)PIECE - 1) / PIECE;
    s->pieces = arena_alloc_zeroed(s->scratch, pieces * sizeof *s->pieces);
    s->rooms = arena_array(s->scratch, (size_t)threads, sizeof *s->rooms);
    if (!s->pieces || !s->rooms) {
        no_memory(s);
        return false;
    }
    for (int i = 0; i < threads; i++)
        fan_room_start(&s->rooms[i], s->watch);
    pool_run(s->pool, pieces, fan_piece, s);
    uint64_t total = 0; // at most one for each corner, and there are fewer than 2³² of those
    for (size_t i = 0; i < pieces; i++) {
        s->pieces[i].before = (uint32_t)total;
        total += s->pieces[i].count;
    }
    if (goes_on(s)) {
        s->normals = arena_array(arena, total, sizeof *s->normals);
        if (s->normals) {
            pool_run(s->pool, pieces, copy_piece, s);
            pool_run(s->pool, (s->corners + s->chunk - 1) / s->chunk, shift_chunk, s);
            s->normal_count = (uint32_t)total;
        } else
            no_memory(s);
    }
    for (int i = 0; i < threads; i++)
        fan_room_free(&s->rooms[i]);
    return goes_on(s);
}

static bool failed(const struct smoothing *s, lam_error *error)
{
    return s->out_of_memory ? watch_memory_error(s->watch, s->corners * 8, error)
                            : watch_error(s->watch, error);
}

bool normals_smooth(lam_mesh *mesh, double crease_angle_rad, struct arena *arena, struct pool *pool,
                    struct watch *watch, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, watch);
    struct smoothing s = {
        .mesh = mesh,
        .least_cosine = math_cos(crease_angle_rad) - CREASE_SLACK,
        .scratch = &scratch,
        .pool = pool,
        .watch = watch,
        .vertices = mesh->indices ? mesh->vertex_count : (size_t)mesh->triangle_count * 3,
        .corners = (size_t)mesh->triangle_count * 3,
    };
    s.indices = arena_array(arena, s.corners, sizeof *s.indices);
    s.position_of = arena_array(&scratch, s.vertices, sizeof *s.position_of);
    if (!s.indices || !s.position_of)
        no_memory(&s);
    bool ok = goes_on(&s) && weld(&s);
    if (ok) {
        s.heads = arena_array(&scratch, s.positions, sizeof *s.heads);
        if (s.heads) {
            memset(s.heads, 0xff, s.positions * sizeof *s.heads);
            s.chunk = CHUNK;
            pool_run(pool, (s.corners + s.chunk - 1) / s.chunk, link_chunk, &s);
        } else
            no_memory(&s);
        ok = goes_on(&s) && make_fans(&s, arena);
    }
    if (ok) {
        mesh->normals = &s.normals[0][0];
        mesh->normal_count = s.normal_count;
        mesh->normal_indices = s.indices;
    }
    arena_free(&scratch);
    return ok || failed(&s, error);
}

// --- Facet normals

struct facets {
    const lam_mesh *mesh;
    struct watch *watch;
    float (*normals)[3];
    uint32_t *indices;
    int stopped;
};

static void facet_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct facets *f = user;
    if (__atomic_load_n(&f->stopped, __ATOMIC_RELAXED) || !watch_on(f->watch)) {
        __atomic_store_n(&f->stopped, 1, __ATOMIC_RELAXED);
        return;
    }
    size_t end =
        (index + 1) * CHUNK < f->mesh->triangle_count ? (index + 1) * CHUNK : f->mesh->triangle_count;
    for (size_t t = index * CHUNK; t < end; t++) {
        lam_vec3 p[3];
        for (size_t k = 0; k < 3; k++) {
            const float *at = f->mesh->positions + 3 * (size_t)corner_vertex(f->mesh, 3 * t + k);
            p[k] = v3((double)at[0], (double)at[1], (double)at[2]);
            f->indices[3 * t + k] = (uint32_t)t;
        }
        lam_vec3 n = v3_unit(v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0])));
        f->normals[t][0] = (float)n.x;
        f->normals[t][1] = (float)n.y;
        f->normals[t][2] = (float)n.z;
    }
}

bool normals_facet(lam_mesh *mesh, struct arena *arena, struct pool *pool, struct watch *watch,
                   lam_error *error)
{
    struct facets f = {.mesh = mesh, .watch = watch};
    f.normals = arena_array(arena, mesh->triangle_count, sizeof *f.normals);
    f.indices = arena_array(arena, (size_t)mesh->triangle_count * 3, sizeof *f.indices);
    if (!f.normals || !f.indices)
        return watch_memory_error(watch, (size_t)mesh->triangle_count * 24, error);
    pool_run(pool, ((size_t)mesh->triangle_count + CHUNK - 1) / CHUNK, facet_chunk, &f);
    if (f.stopped)
        return watch_error(watch, error);
    mesh->normals = &f.normals[0][0];
    mesh->normal_count = mesh->triangle_count;
    mesh->normal_indices = f.indices;
    return true;
}
