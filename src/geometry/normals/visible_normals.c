// visible_normals.c: smooth normals for some triangles of a mesh, or for all of them.
//
// Three steps. Positions (shared_positions.c): every vertex at a position of the set's triangles gets the position's
// number. Bins (position_bins.c): the corners there are sorted by ranges of positions. Fans (corner_fan.c): range by range
// the corners of each position are put in order and their normals computed; positions with equally few corners wait until
// 32 of them can be computed side by side (corner_fan_simd.c).
#include "visible_normals.h"

#include "corner_fan.h"
#include "corner_fan_batch.h"
#include "position_bins.h"

#include <string.h>

// One thread's.
struct fan_worker {
    struct arena arena;
    struct corner_fan_scratch scratch;
    struct corner_fan_batch *batch;
    uint32_t *sorted; // the corners of a bin, by position
    size_t sorted_capacity;
    uint32_t *starts;                     // in `sorted`, of each position of a bin
    uint32_t next_element, elements_left; // reserved for this thread
    uint32_t coming;                      // positions without elements yet: each needs one at least
};

struct fan_loop {
    struct position_search *search;
    struct position_bins bins;
    const struct corner_fan_simd *simd;
    double min_cosine;
    struct visible_normals *visible;
    struct fan_worker *workers;
};

// A new element with the normal x, y, z. `needed`: the number of elements that are needed in any case, this one
// included. They are reserved together, so that the counter that all threads share is rarely touched.
static uint32_t new_element(struct fan_loop *l, struct fan_worker *worker, uint32_t needed, uint32_t first_corner,
                            float x, float y, float z)
{
    struct visible_normals *visible = l->visible;
    if (!worker->elements_left) {
        worker->elements_left = needed + worker->coming;
        worker->next_element = __atomic_fetch_add(&visible->used, worker->elements_left, __ATOMIC_RELAXED);
    }
    uint32_t element = worker->next_element++;
    worker->elements_left--;
    visible->normals[element][0] = x;
    visible->normals[element][1] = y;
    visible->normals[element][2] = z;
    if (visible->first_corners)
        visible->first_corners[element] = first_corner;
    return element;
}

// Makes the normals at one position.
static bool make_fans(struct fan_loop *l, struct fan_worker *worker, const uint32_t *corners, uint32_t count)
{
    const struct rank_bitset *triangles = &l->visible->triangles;
    struct corner_fan_scratch *scratch = &worker->scratch;
    worker->coming--;
    if (!corner_fan_scratch_reserve(scratch, count))
        return false;
    memcpy(scratch->numbers, corners, count * sizeof *corners);
    sort_corners(scratch->numbers, count);
    uint32_t fans = corner_fan_normals(l->search->mesh, l->min_cosine, scratch, count);
    uint32_t *element_of = scratch->numbers; // no longer needed
    memset(element_of, 0xff, fans * sizeof *element_of);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t corner = scratch->corners[i].corner, fan = scratch->corners[i].fan;
        size_t number = l->search->first + (size_t)corner / 3;
        const float *n = scratch->normals[fan];
        if (!rank_bitset_has(triangles, number))
            continue;
        if (element_of[fan] == NONE)
            element_of[fan] = new_element(l, worker, 1, corner, n[0], n[1], n[2]);
        l->visible->elements[3 * (size_t)rank_bitset_rank(triangles, number) + corner % 3] = element_of[fan];
    }
    return true;
}

// Makes the normals at the positions that wait with that many corners; fans without a corner of the set get no element.
static bool make_block(struct fan_loop *l, struct fan_worker *worker, uint32_t count)
{
    struct corner_fan_block *block = &worker->batch->block;
    if (!corner_fan_batch_take(worker->batch, count))
        return true;
    worker->coming -= block->positions;
    l->simd->make(block, l->search->mesh, l->min_cosine);
    uint32_t needed = l->simd->locate(block, &l->visible->triangles, l->search->first);
    for (uint32_t f = 0; f < block->fans; f++)
        for (uint32_t p = 0; p < block->positions; p++) {
            uint32_t members = block->members[f][p];
            float(*unit)[FAN_POSITIONS] = block->unit[f];
            if (!members)
                continue;
            uint32_t first = block->corners[__builtin_ctz(members)][p], no_member;
            uint32_t element = new_element(l, worker, needed--, first, unit[0][p], unit[1][p], unit[2][p]);
            for (uint32_t i = 0; i < count; i++)
                *(members >> i & 1 ? &l->visible->elements[block->elements[i][p]] : &no_member) = element;
        }
    bool ok = true;
    for (uint32_t p = 0; ok && p < block->positions; p++)
        if (block->flat[p]) {
            worker->coming++;
            uint32_t corners[FAN_CORNERS_MAX];
            for (uint32_t i = 0; i < count; i++)
                corners[i] = block->corners[i][p];
            ok = make_fans(l, worker, corners, count);
        }
    return ok;
}

// Makes the normals at one position, now or together with others.
static bool add_position(struct fan_loop *l, struct fan_worker *worker, const uint32_t *corners, uint32_t count)
{
    if (count > FAN_CORNERS_MAX)
        return make_fans(l, worker, corners, count);
    return !corner_fan_batch_add(worker->batch, corners, count) || make_block(l, worker, count);
}

static bool reserve_sorted(struct fan_loop *l, struct fan_worker *worker, size_t bin)
{
    size_t count = position_bin_corners(&l->bins, bin);
    if (count <= worker->sorted_capacity)
        return true;
    worker->sorted_capacity = count + count / 2;
    worker->sorted = search_alloc(l->search, &worker->arena, worker->sorted_capacity, sizeof *worker->sorted);
    return worker->sorted != NULL;
}

static void make_bin(void *user, size_t index, int thread)
{
    struct fan_loop *l = user;
    if (!should_continue(&l->search->loop))
        return;
    struct fan_worker *worker = &l->workers[thread];
    bool ok = reserve_sorted(l, worker, index);
    if (ok)
        position_bin_sort(&l->bins, index, worker->sorted, worker->starts);
    const uint32_t *starts = worker->starts, size = (uint32_t)1 << l->bins.shift;
    for (uint32_t i = 0; ok && i < size; i++)
        worker->coming += starts[i + 1] > starts[i];
    for (uint32_t i = 0; ok && i < size; i++)
        if (starts[i + 1] > starts[i])
            ok = add_position(l, worker, worker->sorted + starts[i], starts[i + 1] - starts[i]);
    if (!ok)
        no_memory(&l->search->loop);
}

// Makes the normals at the positions that still wait with a worker.
static void make_rest(void *user, size_t index, int thread)
{
    (void)thread;
    struct fan_loop *l = user;
    for (uint32_t count = 1; count <= FAN_CORNERS_MAX && should_continue(&l->search->loop); count++)
        if (!make_block(l, &l->workers[index], count))
            no_memory(&l->search->loop);
}

static bool start_workers(struct fan_loop *l)
{
    struct position_search *s = l->search;
    size_t threads = (size_t)pool_threads(s->pool);
    l->workers = search_alloc_zeroed(s, threads * sizeof *l->workers);
    if (!l->workers)
        return false;
    for (size_t i = 0; i < threads; i++) {
        struct fan_worker *worker = &l->workers[i];
        arena_start(&worker->arena, s->loop.call);
        corner_fan_scratch_start(&worker->scratch, s->loop.call);
        worker->starts = search_alloc(s, &s->arena, ((size_t)1 << l->bins.shift) + 1, sizeof *worker->starts);
        worker->batch = search_alloc(s, &s->arena, 1, sizeof *worker->batch);
        if (!worker->starts || !worker->batch)
            return false;
        corner_fan_batch_start(worker->batch);
    }
    return true;
}

static void stop_workers(struct fan_loop *l)
{
    for (int i = 0; l->workers && i < pool_threads(l->search->pool); i++) {
        arena_free(&l->workers[i].arena);
        corner_fan_scratch_free(&l->workers[i].scratch);
    }
}

// The whole lines of 64 bytes between two addresses.
static struct scratch_memory lines_between(void *from, void *to)
{
    uintptr_t first = ((uintptr_t)from + 63) / 64 * 64, end = (uintptr_t)to / 64 * 64;
    return first < end ? (struct scratch_memory){.memory = (void *)first, .capacity = end - first}
                       : (struct scratch_memory){0};
}

// Until fans are made, the mesh's elements and all unused normals are scratch memory too.
static void lend_normals(struct position_search *s, const struct visible_normals *visible)
{
    uint32_t *elements = visible->elements + 3 * (size_t)s->triangles_of_others;
    size_t own = 3 * (size_t)triangles_before(s, s->mesh->triangle_count);
    s->until_fans[0] = lines_between(elements, elements + own);
    s->until_fans[1] =
        lines_between(visible->normals + visible->used, visible->normals + 3 * (size_t)visible->triangles.count);
}

bool make_visible_normals(const lam_mesh *mesh, uint32_t first, double crease_angle_rad,
                          struct visible_normals *visible, struct scratch_memory scratch, int lanes, struct pool *pool,
                          struct call_control *call, lam_error *error)
{
    size_t corners = 3 * (size_t)mesh->triangle_count;
    struct position_search s = {.mesh = mesh,
                                .triangles = &visible->triangles,
                                .first = first,
                                .simd = position_simd_for(lanes),
                                .pool = pool,
                                .loop = {.call = call},
                                .scratch = scratch,
                                .vertices = mesh->indices ? mesh->vertex_count : corners,
                                .corners = corners};
    struct fan_loop l = {.search = &s,
                         .simd = corner_fan_simd_for(lanes),
                         .min_cosine = min_crease_cosine(crease_angle_rad),
                         .visible = visible};
    arena_start(&s.arena, call);
    s.triangles_of_others = triangles_before(&s, 0);
    lend_normals(&s, visible);
    bool ok = find_positions(&s, error);
    if (ok && !position_bins_fill(&l.bins, &s) && should_continue(&s.loop)) {
        ok = find_positions_by_sorting(&s, error);
        if (ok)
            position_bins_fill(&l.bins, &s);
    }
    scratch_return(&s.scratch);
    if (ok && should_continue(&s.loop)) {
        if (!start_workers(&l))
            no_memory(&s.loop);
        pool_run(pool, l.bins.count, make_bin, &l);
        pool_run(pool, (size_t)pool_threads(pool), make_rest, &l);
    }
    if (ok)
        ok = should_continue(&s.loop) || loop_error(&s.loop, corners * 8, error);
    stop_workers(&l);
    position_search_free(&s);
    return ok;
}
