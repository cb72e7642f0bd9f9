// seen_normals.c: smooth normals for the triangles that a picture shows, and for no others.
//
// The vertices of those triangles go into a table by position. Then every vertex of the mesh is looked up in
// it, which tells the corners that count: each goes into the bin of its position's range of numbers, and the
// fans (normals_fan.c) are made range by range. Vertices that are not seen are turned away by a small table
// of single bits before the large one is asked. Threads share both tables; that they insert in any order
// shows only in where things lie, never in a normal.
#include "seen_normals.h"

#include "fan_batch.h"
#include "halt.h"
#include "linear.h"
#include "normals_fan.h"
#include "weld.h"

#include <string.h>

enum {
    WORDS = 1 << 10,  // of a set, in one piece of work
    CHUNK = 1 << 16,  // vertices or corners of one piece
    BATCH = 64,       // vertices looked up at a time
    RANGE_SHIFT = 11, // positions of a range, at least 2^
    RANGES_MAX = 1 << 10,
    BLOCK_VALUES = 508, // in a block of a bin; even
    SLAB = 2 << 20,
};

#define NONE UINT32_MAX

// Corners, each behind the number of its position where that cannot be asked for again.
struct corner_block {
    struct corner_block *before;
    uint32_t count; // of values
    uint32_t values[BLOCK_VALUES];
};

// What a thread holds.
struct worker {
    struct arena arena;
    struct corner_block **bins; // of each range, the newest block
    char *slab;
    size_t slab_left;
    struct fan_room room;
    struct fan_batch *batch;
    uint32_t *sorted; // the corners of a range
    size_t sorted_room;
    uint32_t *starts; // of each position of a range, in `sorted`
};

struct seeing {
    const lam_mesh *mesh;
    uint32_t first; // number of the mesh's triangle 0
    double least_cosine;
    const struct fan_lanes *lanes;
    struct seen_normals *seen;
    struct pool *pool;
    struct halt halt;
    struct arena scratch;
    struct spare spare;
    size_t vertices, corners;
    struct number_set shown; // vertices of the triangles that are seen

    uint32_t *slots; // by position: the lowest shown vertex there
    size_t slot_mask;
    uint32_t *filter_bits; // a bit for some bits of the hash
    struct fan_filter filter;
    int crowded; // touched atomically: a file was made so that positions fall into few slots

    uint32_t
        *position_of; // vertex → number of its position, NONE: none of a seen triangle; NULL: ask the table
    size_t positions;
    unsigned range_shift;
    size_t ranges;
    size_t slab;
    struct worker *workers;
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

// From the spare memory while there is some, by any thread; else from the arena.
static void *take(struct seeing *s, struct arena *arena, size_t count, size_t size)
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

static void *take_zeroed(struct seeing *s, size_t bytes)
{
    void *memory = take(s, &s->scratch, bytes, 1);
    if (memory)
        memset(memory, 0, bytes);
    return memory;
}

static size_t pieces_of(size_t total, size_t piece) { return (total + piece - 1) / piece; }

static size_t piece_end(size_t index, size_t total, size_t piece)
{
    return (index + 1) * piece < total ? (index + 1) * piece : total;
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
    s->shown.bits = take_zeroed(s, words * sizeof *s->shown.bits);
    s->shown.before = take(s, &s->scratch, words, sizeof *s->shown.before);
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

// No more steps in the table than a well filled one takes; else `crowded` is set. A file can be made to take
// more.
static bool few_steps(struct seeing *s, size_t steps, size_t total)
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
    s->slots = take(s, &s->scratch, slots, sizeof *s->slots);
    s->filter.bits = s->filter_bits = take_zeroed(s, bits / 8);
    if (!s->slots || !s->filter_bits)
        return false;
    memset(s->slots, 0xff, slots * sizeof *s->slots);
    pool_run(s->pool, pieces_of(number_set_words(s->vertices), WORDS), insert_words, s);
    return true;
}

// The position numbers of `count` vertices from `first` on, NONE: none of a seen triangle. Most are none, and
// few of those pass the filter. Returns the steps beyond first slots.
static size_t look_up(const struct seeing *s, size_t first, size_t count, uint32_t out[BATCH])
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

// --- bins

static struct corner_block *new_block(struct seeing *s, struct worker *worker, struct corner_block *before)
{
    if (worker->slab_left < sizeof(struct corner_block)) {
        worker->slab = take(s, &worker->arena, 1, s->slab);
        worker->slab_left = worker->slab ? s->slab : 0;
        if (!worker->slab) {
            no_memory(&s->halt);
            return NULL;
        }
    }
    struct corner_block *block = (struct corner_block *)worker->slab;
    worker->slab += sizeof *block;
    worker->slab_left -= sizeof *block;
    block->before = before;
    block->count = 0;
    return block;
}

static inline bool put(struct seeing *s, struct worker *worker, uint32_t position, uint32_t corner)
{
    struct corner_block **bin = &worker->bins[position >> s->range_shift], *block = *bin;
    if (!block || block->count == BLOCK_VALUES) {
        block = new_block(s, worker, block);
        if (!block)
            return false;
        *bin = block;
    }
    if (!s->position_of)
        block->values[block->count++] = position;
    block->values[block->count++] = corner;
    return true;
}

static void bin_chunk(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!goes_on(&s->halt))
        return;
    struct worker *worker = &s->workers[thread];
    const uint32_t *indices = s->mesh->indices;
    size_t end = piece_end(index, s->corners, CHUNK), steps = 0;
    for (size_t c = index * CHUNK; c < end; c += BATCH) {
        size_t count = end - c < BATCH ? end - c : BATCH;
        uint32_t found[BATCH];
        if (!s->position_of) {
            steps += look_up(s, c, count, found);
            if (!few_steps(s, steps, CHUNK))
                return;
        } else
            for (size_t i = 0; i < count; i++)
                found[i] = s->position_of[indices ? indices[c + i] : c + i];
        uint32_t kept[BATCH], keeping = 0;
        for (uint32_t i = 0; i < count; i++) {
            kept[keeping] = i;
            keeping += found[i] != NONE;
        }
        for (uint32_t k = 0; k < keeping; k++)
            if (!put(s, worker, found[kept[k]], (uint32_t)(c + kept[k])))
                return;
    }
}

// --- fans

// Gives a corner of a triangle that is seen its fan's normal. element_of[fan] is NONE until one has it.
static inline void hand_out(struct seeing *s, uint32_t corner, uint32_t fan, const float normal[3],
                            uint32_t *element_of)
{
    const struct number_set *triangles = &s->seen->triangles;
    uint32_t triangle = corner / 3;
    size_t number = s->first + (size_t)triangle;
    if (!number_set_holds(triangles, number))
        return;
    uint32_t element = 3 * number_set_place(triangles, number) + (corner - 3 * triangle);
    if (element_of[fan] == NONE) {
        element_of[fan] = element;
        memcpy(s->seen->normals[element], normal, 3 * sizeof *normal);
    }
    s->seen->elements[element] = element_of[fan];
}

// The normals at one position.
static bool make_fans(struct seeing *s, struct fan_room *room, const uint32_t *corners, uint32_t count)
{
    if (!fan_room_reserve(room, count))
        return false;
    memcpy(room->corners, corners, count * sizeof *corners);
    uint32_t fans = fan_normals(s->mesh, s->least_cosine, room, count);
    uint32_t *element_of = room->corners; // free again
    memset(element_of, 0xff, fans * sizeof *element_of);
    for (uint32_t i = 0; i < count; i++)
        hand_out(s, room->spokes[i].corner, room->spokes[i].fan, room->normals[room->spokes[i].fan],
                 element_of);
    return true;
}

// The normals at the positions that were gathered.
static bool make_batch(struct seeing *s, struct worker *worker)
{
    struct fan_batch *batch = worker->batch;
    uint32_t element_of[FAN_CORNERS];
    fan_batch_make(batch, s->mesh, s->least_cosine, s->lanes);
    memset(element_of, 0xff, batch->fans * sizeof *element_of);
    for (uint32_t p = 0; p < batch->places; p++) {
        const struct fan_place *place = &batch->place[p];
        if (!place->done && !make_fans(s, &worker->room, batch->corner + place->first, place->count))
            return false;
        for (uint32_t i = place->first; place->done && i < (uint32_t)place->first + place->count; i++) {
            uint32_t fan = batch->fan[i];
            const struct fan_sums *sums = &batch->sums;
            float normal[3] = {sums->unit[0][fan], sums->unit[1][fan], sums->unit[2][fan]};
            hand_out(s, batch->corner[i], fan, normal, element_of);
        }
    }
    fan_batch_empty(batch);
    return true;
}

// The normals at one position, now or with others.
static bool add_position(struct seeing *s, struct worker *worker, uint32_t *corners, uint32_t count)
{
    fan_sort(corners, count);
    if (count > FAN_FEW)
        return make_fans(s, &worker->room, corners, count);
    return fan_batch_add(worker->batch, corners, count) ||
           (make_batch(s, worker) && fan_batch_add(worker->batch, corners, count));
}

// The position of value i of a block, a corner.
static inline uint32_t position_at(const struct seeing *s, const struct corner_block *block, uint32_t i)
{
    return s->position_of ? s->position_of[corner_vertex(s->mesh, block->values[i])] : block->values[i - 1];
}

static void fan_range(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!goes_on(&s->halt))
        return;
    struct worker *worker = &s->workers[thread];
    size_t first = index << s->range_shift, size = (size_t)1 << s->range_shift;
    uint32_t *starts = worker->starts, end = 0, step = s->position_of ? 1 : 2;
    memset(starts, 0, (size + 1) * sizeof *starts);
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct corner_block *b = s->workers[t].bins[index]; b; b = b->before)
            for (uint32_t i = step - 1; i < b->count; i += step)
                starts[position_at(s, b, i) - first]++;
    for (size_t i = 0; i <= size; i++)
        starts[i] = end += starts[i];
    if (end > worker->sorted_room) {
        worker->sorted_room = end + end / 2;
        worker->sorted = take(s, &worker->arena, worker->sorted_room, sizeof *worker->sorted);
        if (!worker->sorted) {
            worker->sorted_room = 0;
            no_memory(&s->halt);
            return;
        }
    }
    // From the back, and from the newest block to the oldest: a thread's corners then come in order.
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct corner_block *b = s->workers[t].bins[index]; b; b = b->before)
            for (uint32_t i = b->count; i > 0; i -= step)
                worker->sorted[--starts[position_at(s, b, i - 1) - first]] = b->values[i - 1];
    bool ok = true;
    for (size_t i = 0; ok && i < size; i++)
        if (starts[i + 1] > starts[i])
            ok = add_position(s, worker, worker->sorted + starts[i], starts[i + 1] - starts[i]);
    if (!ok || !make_batch(s, worker))
        no_memory(&s->halt);
}

static bool start_workers(struct seeing *s)
{
    s->range_shift = RANGE_SHIFT;
    while (s->positions >> s->range_shift >= RANGES_MAX)
        s->range_shift++;
    s->ranges = (s->positions >> s->range_shift) + 1;
    // Blocks for a small model come in small slabs.
    s->slab = SLAB;
    while (s->slab > 16 * sizeof(struct corner_block) && s->slab / 2 > s->corners * 8)
        s->slab /= 2;
    size_t threads = (size_t)pool_threads(s->pool);
    s->workers = take_zeroed(s, threads * sizeof *s->workers);
    if (!s->workers)
        return false;
    for (size_t i = 0; i < threads; i++) {
        struct worker *worker = &s->workers[i];
        arena_start(&worker->arena, s->halt.watch);
        fan_room_start(&worker->room, s->halt.watch);
        worker->bins = take_zeroed(s, s->ranges * sizeof(struct corner_block *));
        worker->starts = take(s, &s->scratch, ((size_t)1 << s->range_shift) + 1, sizeof *worker->starts);
        worker->batch = take(s, &s->scratch, 1, sizeof *worker->batch);
        if (!worker->bins || !worker->starts || !worker->batch)
            return false;
        fan_batch_start(worker->batch);
    }
    return true;
}

// Where the table does not serve: all vertices are welded, in time that no file can stretch.
static bool weld_all(struct seeing *s, lam_error *error)
{
    uint32_t positions;
    s->position_of = take(s, &s->scratch, s->vertices, sizeof *s->position_of);
    if (!s->position_of)
        return watch_memory_error(s->halt.watch, s->vertices * 4, error);
    if (!weld_positions(s->mesh->positions, s->vertices, s->position_of, &positions, s->pool, s->halt.watch,
                        error))
        return false;
    uint8_t *shown = take_zeroed(s, positions);
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

// The table, and what it says of each vertex; of a mesh without indices its corners are asked for later.
static bool find_positions(struct seeing *s, lam_error *error)
{
    if (!find_shown(s) || !fill_table(s))
        return watch_memory_error(s->halt.watch, s->vertices / 4, error);
    s->positions = s->shown.count;
    if (s->mesh->indices && !s->crowded) {
        s->position_of = take(s, &s->scratch, s->vertices, sizeof *s->position_of);
        if (!s->position_of)
            return watch_memory_error(s->halt.watch, s->vertices * 4, error);
        pool_run(s->pool, pieces_of(s->vertices, CHUNK), place_chunk, s);
    }
    return !s->crowded || weld_all(s, error);
}

static void stop_workers(struct seeing *s)
{
    for (int i = 0; s->workers && i < pool_threads(s->pool); i++) {
        arena_free(&s->workers[i].arena);
        fan_room_free(&s->workers[i].room);
    }
    s->workers = NULL;
}

static bool bin_corners(struct seeing *s)
{
    if (!start_workers(s))
        no_memory(&s->halt);
    if (goes_on(&s->halt))
        pool_run(s->pool, pieces_of(s->corners, CHUNK), bin_chunk, s);
    return goes_on(&s->halt);
}

bool normals_seen(const lam_mesh *mesh, uint32_t first, double crease_angle_rad, struct seen_normals *seen,
                  struct spare spare, int lanes, struct pool *pool, struct watch *watch, lam_error *error)
{
    size_t corners = 3 * (size_t)mesh->triangle_count;
    struct seeing s = {.mesh = mesh,
                       .first = first,
                       .least_cosine = fan_least_cosine(crease_angle_rad),
                       .lanes = fan_lanes_of(lanes),
                       .seen = seen,
                       .spare = spare,
                       .pool = pool,
                       .halt = {.watch = watch},
                       .vertices = mesh->indices ? mesh->vertex_count : corners,
                       .corners = corners};
    arena_start(&s.scratch, watch);
    bool ok = find_positions(&s, error);
    if (ok) {
        bool binned = bin_corners(&s);
        if (binned && s.crowded && !s.position_of) {
            stop_workers(&s);
            ok = weld_all(&s, error);
            binned = ok && bin_corners(&s);
        }
        if (binned)
            pool_run(pool, s.ranges, fan_range, &s);
        if (ok)
            ok = goes_on(&s.halt) || halt_error(&s.halt, corners * 8, error);
    }
    stop_workers(&s);
    arena_free(&s.scratch);
    return ok;
}
