// visible_normals.c: computes smooth normals for some or all triangles of a mesh.
//
// Closed vertices (normals.h) are processed first. Closed vertices need no search, because the corners that use each
// vertex are simply collected. All other vertices are processed in three steps. First (shared_positions.c), the
// positions of these vertices are numbered, and every vertex at such a position is found. Second (position_bins.c), the
// corners at these positions are sorted into bins, one for each range of positions. Third (corner_fan.c), the corners
// of each bin are sorted by position, and the normals are computed. Positions with the same small number of corners are
// collected until 32 of them can be computed in parallel lanes (corner_fan_simd.c).
#include "visible_normals.h"

#include "corner_fan.h"
#include "facets.h"
#include "normals.h"
#include "positions.h"

#include <string.h>

enum {
    CLOSED_MAX = 8, // the maximum number of corners of a closed vertex
    LISTED = 256,   // corners listed together
    WORDS = 1 << 6, // words of vertices per task
};

// The state of one thread.
struct fan_worker {
    struct arena arena;
    struct corner_fan_scratch scratch;
    struct corner_fan_batch *batch;
    uint32_t *sorted; // the corners of a bin, sorted by position
    size_t sorted_capacity;
    uint32_t *starts; // offset in `sorted` of each position of a bin
};

struct fan_loop {
    struct position_search *search;
    struct position_bins bins;
    const struct corner_fan_simd *simd;
    double min_cosine;
    struct visible_normals *visible;
    struct fan_worker *workers;
    // While closed vertices are processed, open vertices are only listed.
    bool by_vertex;
    struct rank_bitset open;
    uint32_t *counts, (*collected)[CLOSED_MAX]; // for each wanted vertex, its number of corners and its first corners
};

// Fills an element with the normal x, y, z.
static void fill_element(struct visible_normals *visible, uint32_t element, uint32_t first_corner, float x, float y,
                         float z)
{
    visible->normals[element][0] = x;
    visible->normals[element][1] = y;
    visible->normals[element][2] = z;
    if (visible->first_corners)
        visible->first_corners[element] = first_corner;
}

// Computes the normals at one position.
static bool make_fans(struct fan_loop *l, struct fan_worker *worker, const uint32_t *corners, uint32_t count)
{
    const struct rank_bitset *triangles = &l->visible->triangles, *done = &l->search->done;
    const uint32_t *indices = l->search->mesh->indices;
    struct corner_fan_scratch *scratch = &worker->scratch;
    if (!corner_fan_scratch_reserve(scratch, count))
        return false;
    memcpy(scratch->numbers, corners, count * sizeof *corners);
    sort_corners(scratch->numbers, count);
    uint32_t fans = corner_fan_normals(l->search->mesh, l->min_cosine, scratch, count);
    uint32_t *element_of = scratch->numbers; // reuses the array of numbers, which is no longer needed
    memset(element_of, 0xff, fans * sizeof *element_of);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t corner = scratch->corners[i].corner, fan = scratch->corners[i].fan;
        size_t number = l->search->first + (size_t)corner / 3;
        const float *n = scratch->normals[fan];
        if (!rank_bitset_has(triangles, number) || (done->bits && rank_bitset_has(done, indices[corner])))
            continue;
        if (element_of[fan] == NONE) {
            element_of[fan] = __atomic_fetch_add(&l->visible->used, 1, __ATOMIC_RELAXED);
            fill_element(l->visible, element_of[fan], corner, n[0], n[1], n[2]);
        }
        l->visible->elements[3 * (size_t)rank_bitset_rank(triangles, number) + corner % 3] = element_of[fan];
    }
    return true;
}

// Computes the normals at the collected positions that have `count` corners. Fans without a corner in the set get no
// element.
static bool make_block(struct fan_loop *l, struct fan_worker *worker, uint32_t count)
{
    struct corner_fan_block *block = &worker->batch->block;
    if (!corner_fan_batch_take(worker->batch, count))
        return true;
    block->by_vertex = l->by_vertex;
    l->simd->make(block, l->search->mesh, l->min_cosine);
    uint32_t needed =
        l->simd->locate(block, l->search->mesh, &l->visible->triangles, l->search->first, l->search->done.bits);
    uint32_t element = __atomic_fetch_add(&l->visible->used, needed, __ATOMIC_RELAXED);
    for (uint32_t f = 0; f < block->fans; f++)
        for (uint32_t p = 0; p < block->positions; p++) {
            uint32_t members = block->members[f][p];
            float(*unit)[FAN_POSITIONS] = block->unit[f];
            if (!members)
                continue;
            uint32_t first = block->corners[__builtin_ctz(members)][p], no_member;
            fill_element(l->visible, element, first, unit[0][p], unit[1][p], unit[2][p]);
            for (uint32_t i = 0; i < count; i++)
                *(members >> i & 1 ? &l->visible->elements[block->elements[i][p]] : &no_member) = element;
            element++;
        }
    bool ok = true;
    for (uint32_t p = 0; ok && p < block->positions; p++)
        if (block->open[p]) {
            rank_bitset_add(&l->open, l->search->mesh->indices[block->corners[0][p]]);
        } else if (block->flat[p]) {
            uint32_t corners[FAN_CORNERS_MAX];
            for (uint32_t i = 0; i < count; i++)
                corners[i] = block->corners[i][p];
            ok = make_fans(l, worker, corners, count);
        }
    return ok;
}

// Computes the normals at one position, immediately or later together with other positions.
static bool add_position(struct fan_loop *l, struct fan_worker *worker, const uint32_t *corners, uint32_t count)
{
    if (count > FAN_CORNERS_MAX)
        return make_fans(l, worker, corners, count);
    const lam_mesh *mesh = l->search->mesh;
    for (uint32_t i = 0; i < count; i++) { // prefetches the data that a full batch reads
        size_t first = (size_t)corners[i] / 3 * 3;
        if (mesh->indices) {
            __builtin_prefetch(mesh->indices + first);
        } else {
            __builtin_prefetch(mesh->positions + 3 * first);
            __builtin_prefetch(mesh->positions + 3 * first + 8);
        }
    }
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
        if (starts[i + 1] > starts[i])
            ok = add_position(l, worker, worker->sorted + starts[i], starts[i + 1] - starts[i]);
    if (!ok)
        no_memory(&l->search->loop);
}

// Computes the normals at the positions in a worker's incomplete blocks.
static void make_rest(void *user, size_t index, int thread)
{
    (void)thread;
    struct fan_loop *l = user;
    for (uint32_t count = 1; count <= FAN_CORNERS_MAX && should_continue(&l->search->loop); count++)
        if (!make_block(l, &l->workers[index], count))
            no_memory(&l->search->loop);
}

static void stop_workers(struct fan_loop *l)
{
    for (int i = 0; l->workers && i < pool_threads(l->search->pool); i++) {
        arena_free(&l->workers[i].arena);
        corner_fan_scratch_free(&l->workers[i].scratch);
    }
}

static bool start_workers(struct fan_loop *l)
{
    struct position_search *s = l->search;
    size_t threads = (size_t)pool_threads(s->pool);
    stop_workers(l);
    l->workers = arena_alloc_zeroed(&s->of_threads, threads * sizeof *l->workers);
    if (!l->workers)
        return false;
    for (size_t i = 0; i < threads; i++) {
        struct fan_worker *worker = &l->workers[i];
        corner_fan_scratch_start(&worker->scratch, NULL);
        worker->starts = arena_array(&s->of_threads, ((size_t)1 << l->bins.shift) + 1, sizeof *worker->starts);
        worker->batch = arena_array(&s->of_threads, 1, sizeof *worker->batch);
        if (!worker->starts || !worker->batch)
            return false;
        corner_fan_batch_start(worker->batch);
    }
    return true;
}

// Returns the memory between two addresses, reduced to complete lines of 64 bytes.
static struct scratch_memory lines_between(void *from, void *to)
{
    uintptr_t first = ((uintptr_t)from + 63) / 64 * 64, end = (uintptr_t)to / 64 * 64;
    return first < end ? (struct scratch_memory){.memory = (void *)first, .capacity = end - first}
                       : (struct scratch_memory){0};
}

// Until fans are computed, the memory of the mesh's elements and of all unused normals is used as scratch memory.
static void lend_normals(struct position_search *s, const struct visible_normals *visible)
{
    uint32_t *elements = visible->elements + 3 * (size_t)s->triangles_of_others;
    size_t own = 3 * (size_t)triangles_before(s, s->mesh->triangle_count);
    s->until_fans[0] = lines_between(elements, elements + own);
    s->until_fans[1] =
        lines_between(visible->normals + visible->used, visible->normals + 3 * (size_t)visible->triangles.count);
}

// --- closed vertices

// Collects the corners of wanted vertices; their order does not matter.
static void collect_corners(void *user, size_t index, int thread)
{
    (void)thread;
    struct fan_loop *l = user;
    struct position_search *s = l->search;
    const bool alone = pool_threads(s->pool) == 1;
    if (!should_continue(&s->loop))
        return;
    uint32_t end = (uint32_t)chunk_end(index, s->corners, CHUNK), count;
    for (uint32_t c = (uint32_t)(index * CHUNK); c < end; c += count) {
        uint32_t corners[LISTED + WORD], ranks[LISTED + WORD];
        count = end - c < LISTED ? end - c : LISTED;
        uint32_t listed = s->simd->list(s->mesh->indices + c, s->position_of, c, count, corners, ranks);
        for (uint32_t k = 0; k < listed; k++) {
            uint32_t *at = &l->counts[ranks[k]];
            uint32_t slot = alone ? (*at)++ : __atomic_fetch_add(at, 1, __ATOMIC_RELAXED);
            if (slot < CLOSED_MAX)
                l->collected[ranks[k]][slot] = corners[k];
        }
    }
}

static void make_vertices(void *user, size_t index, int thread)
{
    struct fan_loop *l = user;
    struct position_search *s = l->search;
    for (size_t w = index * WORDS;
         should_continue(&s->loop) && w < chunk_end(index, rank_bitset_words(s->vertices), WORDS); w++) {
        uint32_t rank = s->wanted.ranks[w];
        for (uint64_t bits = s->wanted.bits[w]; bits; bits &= bits - 1, rank++)
            if (l->counts[rank] < 3 || l->counts[rank] > CLOSED_MAX)
                rank_bitset_add(&l->open, 64 * w + (size_t)__builtin_ctzll(bits));
            else if (!add_position(l, &l->workers[thread], l->collected[rank], l->counts[rank]))
                no_memory(&s->loop);
    }
}

// Computes the normals of closed vertices; all other vertices remain wanted.
static bool make_closed(struct fan_loop *l)
{
    struct position_search *s = l->search;
    size_t words = rank_bitset_words(s->vertices), wanted = s->wanted.count;
    l->open = (struct rank_bitset){.bits = search_alloc_zeroed(s, words * sizeof *l->open.bits),
                                   .ranks = search_alloc(s, &s->arena, words, sizeof *l->open.ranks),
                                   .size = s->vertices};
    l->counts = search_alloc_zeroed(s, wanted * sizeof *l->counts);
    l->collected = search_alloc(s, &s->arena, wanted, sizeof *l->collected);
    if (!l->open.bits || !l->open.ranks || !l->counts || !l->collected || !number_wanted(s) || !start_workers(l))
        return false;
    l->by_vertex = true;
    pool_run(s->pool, chunks_of(s->corners, CHUNK), collect_corners, l);
    pool_run(s->pool, chunks_of(words, WORDS), make_vertices, l);
    pool_run(s->pool, (size_t)pool_threads(s->pool), make_rest, l);
    l->by_vertex = false;
    for (size_t w = 0; w < words; w++)
        s->wanted.bits[w] &= ~l->open.bits[w];
    s->done = s->wanted;
    s->wanted = l->open;
    rank_bitset_finish(&s->wanted);
    s->position_of = NULL;
    lend_normals(s, l->visible);
    s->until_fans[0] = (struct scratch_memory){0}; // some elements are now filled
    return true;
}

// Computes the normals of all other vertices.
static bool make_others(struct fan_loop *l, lam_error *error)
{
    struct position_search *s = l->search;
    bool ok = find_positions(s, error);
    if (ok && !position_bins_fill(&l->bins, s) && should_continue(&s->loop)) {
        ok = find_positions_by_sorting(s, error);
        if (ok)
            position_bins_fill(&l->bins, s);
    }
    scratch_return(&s->scratch);
    if (ok && should_continue(&s->loop)) {
        if (!start_workers(l))
            no_memory(&s->loop);
        pool_run(s->pool, l->bins.count, make_bin, l);
        pool_run(s->pool, (size_t)pool_threads(s->pool), make_rest, l);
    }
    return ok;
}

bool make_visible_normals(const lam_mesh *mesh, uint32_t first, double crease_angle_rad,
                          struct visible_normals *visible, const struct normals_work *work, lam_error *error)
{
    struct pool *pool = work->pool;
    struct call_control *call = work->call;
    if (crease_angle_rad <= FACET_CREASE_RAD)
        return make_visible_facets(mesh, first, visible, pool, call, error);
    size_t corners = 3 * (size_t)mesh->triangle_count;
    struct position_search s = {.mesh = mesh,
                                .triangles = &visible->triangles,
                                .first = first,
                                .simd = position_simd_for(work->lanes),
                                .pool = pool,
                                .loop = {.call = call},
                                .scratch = work->scratch,
                                .vertices = mesh->indices ? mesh->vertex_count : corners,
                                .corners = corners};
    struct fan_loop l = {.search = &s,
                         .simd = corner_fan_simd_for(work->lanes),
                         .min_cosine = min_crease_cosine(crease_angle_rad),
                         .visible = visible};
    arena_start(&s.arena, call);
    s.triangles_of_others = triangles_before(&s, 0);
    lend_normals(&s, visible);
    const bool some_closed = mesh->indices && corners >= 3 * s.vertices;
    bool ok = ((!mesh->indices || find_wanted(&s)) && (!some_closed || make_closed(&l))) ||
              call_memory_error(call, s.vertices / 4, error);
    if (ok && should_continue(&s.loop) && (!s.done.bits || s.wanted.count))
        ok = make_others(&l, error);
    if (ok)
        ok = should_continue(&s.loop) || loop_error(&s.loop, corners * 8, error);
    stop_workers(&l);
    position_search_free(&s);
    return ok;
}
