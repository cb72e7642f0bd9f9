// seen_normals.c: smooth normals for the triangles that a picture shows, and for no others.
//
// Every vertex of the mesh is looked up in a table of the positions that are seen (seen_positions.c), which
// tells the corners that count: each goes into the bin of its position's range of numbers, and the fans
// (normals_fan.c) are made range by range.
#include "seen_positions.h"

#include "fan_batch.h"
#include "linear.h"

#include <string.h>

enum {
    RANGE_SHIFT = 11, // positions of a range, at least 2^
    RANGES_MAX = 1 << 10,
    BLOCK_VALUES = 508, // in a block of a bin; even
    SLAB = 2 << 20,
};

// Corners, each behind the number of its position where that cannot be asked for again.
struct corner_block {
    struct corner_block *before;
    uint32_t count; // of values
    uint32_t values[BLOCK_VALUES];
};

// What a thread holds.
struct seen_worker {
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

// --- bins

static struct corner_block *new_block(struct seeing *s, struct seen_worker *worker,
                                      struct corner_block *before)
{
    if (worker->slab_left < sizeof(struct corner_block)) {
        worker->slab = seeing_take(s, &worker->arena, 1, s->slab);
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

static inline bool put(struct seeing *s, struct seen_worker *worker, uint32_t position, uint32_t corner)
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
    struct seen_worker *worker = &s->workers[thread];
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

// Where the element of a corner stands; NONE: its triangle is not seen.
static inline size_t place_of(const struct seeing *s, uint32_t corner)
{
    const struct number_set *triangles = &s->seen->triangles;
    uint32_t triangle = corner / 3;
    size_t number = s->first + (size_t)triangle;
    return number_set_holds(triangles, number)
               ? 3 * (size_t)number_set_place(triangles, number) + (corner - 3 * triangle)
               : NONE;
}

// The first of `count` elements that nobody has yet.
static inline uint32_t new_elements(struct seeing *s, uint32_t count)
{
    return __atomic_fetch_add(&s->seen->used, count, __ATOMIC_RELAXED);
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
    for (uint32_t i = 0; i < count; i++) {
        size_t place = place_of(s, room->spokes[i].corner);
        uint32_t fan = room->spokes[i].fan;
        if (place == NONE)
            continue;
        if (element_of[fan] == NONE) {
            element_of[fan] = new_elements(s, 1);
            memcpy(s->seen->normals[element_of[fan]], room->normals[fan], sizeof s->seen->normals[0]);
        }
        s->seen->elements[place] = element_of[fan];
    }
    return true;
}

// The normals at the positions that were gathered; fans of which no corner is seen get no element.
static bool make_batch(struct seeing *s, struct seen_worker *worker)
{
    struct fan_batch *batch = worker->batch;
    struct seen_normals *seen = s->seen;
    uint32_t element_of[FAN_CORNERS], elements = 0;
    size_t place_at[FAN_CORNERS];
    fan_batch_make(batch, s->mesh, s->least_cosine, s->lanes);
    memset(element_of, 0xff, batch->fans * sizeof *element_of);
    for (uint32_t p = 0; p < batch->places; p++) {
        const struct fan_place *place = &batch->place[p];
        if (!place->done && !make_fans(s, &worker->room, batch->corner + place->first, place->count))
            return false;
        for (uint32_t i = place->first; i < (uint32_t)place->first + place->count; i++) {
            place_at[i] = place->done ? place_of(s, batch->corner[i]) : NONE;
            if (place_at[i] != NONE && element_of[batch->fan[i]] == NONE)
                element_of[batch->fan[i]] = elements++;
        }
    }
    uint32_t first = new_elements(s, elements);
    for (uint32_t fan = 0; fan < batch->fans; fan++)
        for (uint32_t k = 0; k < 3 && element_of[fan] != NONE; k++)
            seen->normals[first + element_of[fan]][k] = batch->sums.unit[k][fan];
    for (uint32_t i = 0; i < batch->count; i++)
        if (place_at[i] != NONE)
            seen->elements[place_at[i]] = first + element_of[batch->fan[i]];
    fan_batch_empty(batch);
    return true;
}

// The normals at one position, now or with others.
static bool add_position(struct seeing *s, struct seen_worker *worker, uint32_t *corners, uint32_t count)
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
    struct seen_worker *worker = &s->workers[thread];
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
        worker->sorted = seeing_take(s, &worker->arena, worker->sorted_room, sizeof *worker->sorted);
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
    s->workers = seeing_take_zeroed(s, threads * sizeof *s->workers);
    if (!s->workers)
        return false;
    for (size_t i = 0; i < threads; i++) {
        struct seen_worker *worker = &s->workers[i];
        arena_start(&worker->arena, s->halt.watch);
        fan_room_start(&worker->room, s->halt.watch);
        worker->bins = seeing_take_zeroed(s, s->ranges * sizeof(struct corner_block *));
        worker->starts =
            seeing_take(s, &s->scratch, ((size_t)1 << s->range_shift) + 1, sizeof *worker->starts);
        worker->batch = seeing_take(s, &s->scratch, 1, sizeof *worker->batch);
        if (!worker->bins || !worker->starts || !worker->batch)
            return false;
        fan_batch_start(worker->batch);
    }
    return true;
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
