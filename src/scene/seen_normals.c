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
    uint32_t *sorted;                     // the corners of a range, by position
    uint32_t *where;                      // as they come from the bins: their positions in the range
    size_t room_for;                      // of both
    uint32_t *starts;                     // of each position of a range, in `sorted`
    uint32_t next_element, elements_left; // that only this thread may give
    uint32_t coming; // positions whose normals are not yet begun: each needs an element at least
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

// An element with that normal. `needed`: how many are in any case, this one among them. The counter that all
// threads share is rarely touched.
static uint32_t new_element(struct seeing *s, struct seen_worker *worker, uint32_t needed, float x, float y,
                            float z)
{
    if (!worker->elements_left) {
        worker->elements_left = needed + worker->coming;
        worker->next_element = __atomic_fetch_add(&s->seen->used, worker->elements_left, __ATOMIC_RELAXED);
    }
    uint32_t element = worker->next_element++;
    worker->elements_left--;
    s->seen->normals[element][0] = x;
    s->seen->normals[element][1] = y;
    s->seen->normals[element][2] = z;
    return element;
}

// The normals at one position.
static bool make_fans(struct seeing *s, struct seen_worker *worker, const uint32_t *corners, uint32_t count)
{
    const struct number_set *triangles = &s->seen->triangles;
    struct fan_room *room = &worker->room;
    worker->coming--;
    if (!fan_room_reserve(room, count))
        return false;
    memcpy(room->corners, corners, count * sizeof *corners);
    fan_sort(room->corners, count);
    uint32_t fans = fan_normals(s->mesh, s->least_cosine, room, count);
    uint32_t *element_of = room->corners; // free again
    memset(element_of, 0xff, fans * sizeof *element_of);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t corner = room->spokes[i].corner, fan = room->spokes[i].fan;
        size_t number = s->first + (size_t)corner / 3;
        const float *n = room->normals[fan];
        if (!number_set_holds(triangles, number))
            continue;
        if (element_of[fan] == NONE)
            element_of[fan] = new_element(s, worker, 1, n[0], n[1], n[2]);
        s->seen->elements[3 * (size_t)number_set_place(triangles, number) + corner % 3] = element_of[fan];
    }
    return true;
}

// The normals at the positions that wait with that many corners; fans of which no corner is seen get no
// element.
static bool make_block(struct seeing *s, struct seen_worker *worker, uint32_t count)
{
    struct fan_block *block = &worker->batch->block;
    if (!fan_batch_take(worker->batch, count))
        return true;
    worker->coming -= block->places;
    s->lanes->make(block, s->mesh, s->least_cosine);
    uint32_t needed = s->lanes->find(block, &s->seen->triangles, s->first);
    for (uint32_t f = 0; f < block->fans; f++)
        for (uint32_t p = 0; p < block->places; p++) {
            uint32_t members = block->members[f][p];
            float(*unit)[FAN_PLACES] = block->unit[f];
            if (!members)
                continue;
            uint32_t element = new_element(s, worker, needed--, unit[0][p], unit[1][p], unit[2][p]), unseen;
            for (uint32_t i = 0; i < count; i++)
                *(members >> i & 1 ? &s->seen->elements[block->elements[i][p]] : &unseen) = element;
        }
    bool ok = true;
    for (uint32_t p = 0; ok && p < block->places; p++)
        if (block->flat[p]) {
            worker->coming++;
            uint32_t corners[FAN_FEW];
            for (uint32_t i = 0; i < count; i++)
                corners[i] = block->corners[i][p];
            ok = make_fans(s, worker, corners, count);
        }
    return ok;
}

// The normals at one position, now or with others.
static bool add_position(struct seeing *s, struct seen_worker *worker, const uint32_t *corners,
                         uint32_t count)
{
    if (count > FAN_FEW)
        return make_fans(s, worker, corners, count);
    return !fan_batch_add(worker->batch, corners, count) || make_block(s, worker, count);
}

// Room for the corners of a range.
static bool make_room(struct seeing *s, struct seen_worker *worker, size_t index)
{
    size_t count = 0;
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct corner_block *b = s->workers[t].bins[index]; b; b = b->before)
            count += s->position_of ? b->count : b->count / 2;
    if (count <= worker->room_for)
        return true;
    worker->room_for = count + count / 2;
    worker->sorted = seeing_take(s, &worker->arena, worker->room_for, sizeof *worker->sorted);
    worker->where = seeing_take(s, &worker->arena, worker->room_for, sizeof *worker->where);
    return worker->sorted && worker->where;
}

// The positions of a block's corners, numbered from `first`, each counted. Returns how many corners there
// are.
static uint32_t positions_in(const struct seeing *s, const struct corner_block *block, uint32_t first,
                             uint32_t *restrict positions, uint32_t *restrict counts)
{
    const uint32_t *values = block->values, *position_of = s->position_of, *indices = s->mesh->indices;
    uint32_t count = position_of ? block->count : block->count / 2;
    if (!position_of)
        for (uint32_t i = 0; i < count; i++)
            counts[positions[i] = values[2 * i] - first]++;
    else
        for (uint32_t i = 0; i < count; i++)
            counts[positions[i] = position_of[indices ? indices[values[i]] : values[i]] - first]++;
    return count;
}

// Puts the corners of a range in order by position: worker->starts tells where a position's begin.
static void sort_range(struct seeing *s, struct seen_worker *worker, size_t index)
{
    size_t size = (size_t)1 << s->range_shift;
    uint32_t *restrict starts = worker->starts, *restrict sorted = worker->sorted, *where = worker->where;
    uint32_t end = 0, step = s->position_of ? 1 : 2;
    memset(starts, 0, (size + 1) * sizeof *starts);
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct corner_block *b = s->workers[t].bins[index]; b; b = b->before)
            where += positions_in(s, b, (uint32_t)(index << s->range_shift), where, starts);
    for (size_t i = 0; i <= size; i++)
        starts[i] = end += starts[i];
    // From the back, and from the newest block to the oldest: a thread's corners then come in order.
    where = worker->where;
    for (int t = 0; t < pool_threads(s->pool); t++)
        for (const struct corner_block *b = s->workers[t].bins[index]; b; b = b->before) {
            uint32_t count = b->count / step;
            for (uint32_t i = count; i-- > 0;)
                sorted[--starts[where[i]]] = b->values[i * step + step - 1];
            where += count;
        }
}

static void fan_range(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!goes_on(&s->halt))
        return;
    struct seen_worker *worker = &s->workers[thread];
    bool ok = make_room(s, worker, index);
    if (ok)
        sort_range(s, worker, index);
    const uint32_t *starts = worker->starts, size = (uint32_t)1 << s->range_shift;
    for (uint32_t i = 0; ok && i < size; i++)
        worker->coming += starts[i + 1] > starts[i];
    for (uint32_t i = 0; ok && i < size; i++)
        if (starts[i + 1] > starts[i])
            ok = add_position(s, worker, worker->sorted + starts[i], starts[i + 1] - starts[i]);
    if (!ok)
        no_memory(&s->halt);
}

// What waits still with a worker.
static void fan_rest(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    for (uint32_t count = 1; count <= FAN_FEW && goes_on(&s->halt); count++)
        if (!make_block(s, &s->workers[index], count))
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
        if (binned)
            pool_run(pool, (size_t)pool_threads(pool), fan_rest, &s);
        if (ok)
            ok = goes_on(&s.halt) || halt_error(&s.halt, corners * 8, error);
    }
    stop_workers(&s);
    arena_free(&s.scratch);
    return ok;
}
