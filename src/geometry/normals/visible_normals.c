// visible_normals.c: smooth normals for the triangles that a picture shows, and for no others.
//
// Every vertex of the mesh is looked up in a table of the positions that are seen (shared_positions.c), which
// tells the corners that count: each goes into the bin of its position's range of numbers (position_bins.c), and
// the fans (corner_fan.c) are made range by range.
#include "position_bins.h"

#include "corner_fan_batch.h"
#include "linear.h"

#include <string.h>

// What a thread holds.
struct seen_worker {
    struct arena arena;
    struct fan_room room;
    struct fan_batch *batch;
    uint32_t *sorted;                     // the corners of a range, by position
    size_t room_for;                      // corners
    uint32_t *starts;                     // of each position of a range, in `sorted`
    uint32_t next_element, elements_left; // that only this thread may give
    uint32_t coming;                      // positions whose normals are not yet begun: each needs an element at least
};

// An element with that normal. `needed`: how many are in any case, this one among them. The counter that all
// threads share is rarely touched.
static uint32_t new_element(struct seeing *s, struct seen_worker *worker, uint32_t needed, float x, float y, float z)
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

// The normals at the positions that wait with that many corners; fans of which no corner is seen get no element.
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
static bool add_position(struct seeing *s, struct seen_worker *worker, const uint32_t *corners, uint32_t count)
{
    if (count > FAN_FEW)
        return make_fans(s, worker, corners, count);
    return !fan_batch_add(worker->batch, corners, count) || make_block(s, worker, count);
}

// Room for the corners of a range.
static bool make_room(struct seeing *s, struct seen_worker *worker, size_t range)
{
    size_t count = corners_in_range(s, range);
    if (count <= worker->room_for)
        return true;
    worker->room_for = count + count / 2;
    worker->sorted = seeing_take(s, &worker->arena, worker->room_for, sizeof *worker->sorted);
    return worker->sorted != NULL;
}

static void fan_range(void *user, size_t index, int thread)
{
    struct seeing *s = user;
    if (!should_continue(&s->loop))
        return;
    struct seen_worker *worker = &s->workers[thread];
    bool ok = make_room(s, worker, index);
    if (ok)
        sort_range(s, index, worker->sorted, worker->starts);
    const uint32_t *starts = worker->starts, size = (uint32_t)1 << s->range_shift;
    for (uint32_t i = 0; ok && i < size; i++)
        worker->coming += starts[i + 1] > starts[i];
    for (uint32_t i = 0; ok && i < size; i++)
        if (starts[i + 1] > starts[i])
            ok = add_position(s, worker, worker->sorted + starts[i], starts[i + 1] - starts[i]);
    if (!ok)
        no_memory(&s->loop);
}

// What waits still with a worker.
static void fan_rest(void *user, size_t index, int thread)
{
    (void)thread;
    struct seeing *s = user;
    for (uint32_t count = 1; count <= FAN_FEW && should_continue(&s->loop); count++)
        if (!make_block(s, &s->workers[index], count))
            no_memory(&s->loop);
}

static bool start_workers(struct seeing *s)
{
    size_t threads = (size_t)pool_threads(s->pool);
    s->workers = seeing_take_zeroed(s, threads * sizeof *s->workers);
    if (!s->workers)
        return false;
    for (size_t i = 0; i < threads; i++) {
        struct seen_worker *worker = &s->workers[i];
        arena_start(&worker->arena, s->loop.call);
        fan_room_start(&worker->room, s->loop.call);
        worker->starts = seeing_take(s, &s->scratch, ((size_t)1 << s->range_shift) + 1, sizeof *worker->starts);
        worker->batch = seeing_take(s, &s->scratch, 1, sizeof *worker->batch);
        if (!worker->starts || !worker->batch)
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

// Whole lines of 64 bytes from one place to another.
static struct spare lines_between(void *from, void *to)
{
    uintptr_t first = ((uintptr_t)from + 63) / 64 * 64, end = (uintptr_t)to / 64 * 64;
    return first < end ? (struct spare){.memory = (void *)first, .room = end - first} : (struct spare){0};
}

// Until fans are made, the mesh's elements and all normals that nobody has yet are memory like any other.
static void lend_normals(struct seeing *s)
{
    struct seen_normals *seen = s->seen;
    uint32_t *elements = seen->elements + 3 * (size_t)s->seen_before;
    size_t own = 3 * (size_t)seen_triangles_before(s, s->mesh->triangle_count);
    s->until_fans[0] = lines_between(elements, elements + own);
    s->until_fans[1] = lines_between(seen->normals + seen->used, seen->normals + 3 * (size_t)seen->triangles.count);
}

bool normals_seen(const lam_mesh *mesh, uint32_t first, double crease_angle_rad, struct seen_normals *seen,
                  struct spare spare, int lanes, struct pool *pool, struct call_control *call, lam_error *error)
{
    size_t corners = 3 * (size_t)mesh->triangle_count;
    struct seeing s = {.mesh = mesh,
                       .first = first,
                       .least_cosine = fan_least_cosine(crease_angle_rad),
                       .lanes = fan_lanes_of(lanes),
                       .search = seen_lanes_of(lanes),
                       .seen = seen,
                       .spare = spare,
                       .pool = pool,
                       .loop = {.call = call},
                       .vertices = mesh->indices ? mesh->vertex_count : corners,
                       .corners = corners};
    arena_start(&s.scratch, call);
    s.seen_before = seen_triangles_before(&s, 0);
    lend_normals(&s);
    bool ok = find_positions(&s, error);
    if (ok && !bin_corners(&s) && should_continue(&s.loop)) {
        ok = weld_all(&s, error);
        if (ok)
            bin_corners(&s);
    }
    spare_give_back(&s.spare);
    if (ok && should_continue(&s.loop)) {
        if (!start_workers(&s))
            no_memory(&s.loop);
        pool_run(pool, s.ranges, fan_range, &s);
        pool_run(pool, (size_t)pool_threads(pool), fan_rest, &s);
    }
    if (ok)
        ok = should_continue(&s.loop) || loop_error(&s.loop, corners * 8, error);
    stop_workers(&s);
    stop_lists(&s);
    arena_free(&s.scratch);
    return ok;
}
