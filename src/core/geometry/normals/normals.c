// normals.c: computes normals for meshes without normals.
//
// visible_normals.c computes smooth normals, numbered in an order that depends on the threads. This file renumbers the
// normals by their first corner, so that the result does not depend on the threads.
#include "normals.h"

#include "corner_fan.h"
#include "facets.h"
#include "loop_status.h"
#include "visible_normals.h"

#include <string.h>

enum {
    CHUNK = 1 << 16,    // corners or triangles per task
    LANES_MAX = 1 << 8, // more lanes than any processor has
};

static size_t chunks_of(size_t total) { return (total + CHUNK - 1) / CHUNK; }

static size_t chunk_end(size_t index, size_t total)
{
    size_t end = (index + 1) * CHUNK;
    return end < total ? end : total;
}

// --- Smooth normals

struct numbering {
    struct visible_normals made;
    struct rank_bitset first_corners;
    float (*normals)[3]; // indexed by number
    uint32_t *indices;   // per corner: initially an index into `made`, later the final number
    size_t corners;
};

static void mark_first_corners(void *user, size_t index, int thread)
{
    (void)thread;
    struct numbering *n = user;
    for (size_t e = index * CHUNK; e < chunk_end(index, n->made.used); e++)
        rank_bitset_add(&n->first_corners, n->made.first_corners[e]);
}

// Computes the final number of each normal. In the array, this number replaces the normal's first corner.
static void number_normals(void *user, size_t index, int thread)
{
    (void)thread;
    struct numbering *n = user;
    for (size_t e = index * CHUNK; e < chunk_end(index, n->made.used); e++) {
        uint32_t *number = &n->made.first_corners[e];
        *number = rank_bitset_rank(&n->first_corners, *number);
        memcpy(n->normals[*number], n->made.normals[e], sizeof *n->normals);
    }
}

static void number_corners(void *user, size_t index, int thread)
{
    (void)thread;
    struct numbering *n = user;
    for (size_t c = index * CHUNK; c < chunk_end(index, n->corners); c++)
        n->indices[c] = n->made.first_corners[n->indices[c]];
}

// Makes a set with space for `size` numbers. The set contains all numbers if `full` is set, and is empty otherwise.
static bool make_set(struct rank_bitset *set, size_t size, bool full, struct arena *arena)
{
    size_t words = rank_bitset_words(size);
    *set = (struct rank_bitset){.bits = arena_array(arena, words, sizeof *set->bits),
                                .ranks = arena_array(arena, words, sizeof *set->ranks),
                                size};
    if (!set->bits || !set->ranks)
        return false;
    memset(set->bits, full ? 0xff : 0, words * sizeof *set->bits);
    if (full && size % 64)
        set->bits[words - 1] = ((uint64_t)1 << size % 64) - 1;
    if (full)
        rank_bitset_finish(set);
    return true;
}

static bool number(struct numbering *n, struct arena *scratch, struct arena *arena, struct pool *pool)
{
    n->normals = arena_array(arena, n->made.used, sizeof *n->normals);
    if (!n->normals || !make_set(&n->first_corners, n->corners, false, scratch))
        return false;
    pool_run(pool, chunks_of(n->made.used), mark_first_corners, n);
    rank_bitset_finish(&n->first_corners);
    pool_run(pool, chunks_of(n->made.used), number_normals, n);
    pool_run(pool, chunks_of(n->corners), number_corners, n);
    return true;
}

bool normals_smooth(lam_mesh *mesh, double crease_angle_rad, struct arena *arena, struct pool *pool,
                    struct call_control *call, lam_error *error)
{
    if (crease_angle_rad <= FACET_CREASE_RAD)
        return normals_facet(mesh, arena, pool, call, error);
    size_t corners = 3 * (size_t)mesh->triangle_count;
    struct numbering n = {.corners = corners};
    struct arena scratch;
    arena_start(&scratch, call);
    n.indices = n.made.elements = arena_array(arena, corners, sizeof *n.indices);
    n.made.normals = arena_array(&scratch, corners, sizeof *n.made.normals);
    n.made.first_corners = arena_array(&scratch, corners, sizeof *n.made.first_corners);
    bool ok = n.indices && n.made.normals && n.made.first_corners &&
              make_set(&n.made.triangles, mesh->triangle_count, true, &scratch);
    if (!ok)
        call_memory_error(call, corners * 20, error);
    struct normals_work work = {.lanes = LANES_MAX, .pool = pool, .call = call};
    ok = ok && make_visible_normals(mesh, 0, crease_angle_rad, &n.made, &work, error);
    if (ok && !number(&n, &scratch, arena, pool))
        ok = call_memory_error(call, n.made.used * sizeof *n.normals, error);
    if (ok) {
        mesh->normals = &n.normals[0][0];
        mesh->normal_count = n.made.used;
        mesh->normal_indices = n.indices;
    }
    arena_free(&scratch);
    return ok;
}

// --- Facet normals

struct facets {
    const lam_mesh *mesh;
    struct loop_status loop;
    float (*normals)[3];
    uint32_t *indices;
};

static void facet_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct facets *f = user;
    if (!should_continue(&f->loop))
        return;
    for (size_t t = index * CHUNK; t < chunk_end(index, f->mesh->triangle_count); t++) {
        facet_normal(f->mesh, t, f->normals[t]);
        for (size_t k = 0; k < 3; k++)
            f->indices[3 * t + k] = (uint32_t)t;
    }
}

bool normals_facet(lam_mesh *mesh, struct arena *arena, struct pool *pool, struct call_control *call, lam_error *error)
{
    struct facets f = {.mesh = mesh, .loop = {.call = call}};
    size_t count = mesh->triangle_count;
    f.normals = arena_array(arena, count, sizeof *f.normals);
    f.indices = arena_array(arena, count * 3, sizeof *f.indices);
    if (!f.normals || !f.indices)
        return call_memory_error(call, count * 24, error);
    pool_run(pool, chunks_of(count), facet_chunk, &f);
    if (!should_continue(&f.loop))
        return loop_error(&f.loop, count * 24, error);
    mesh->normals = &f.normals[0][0];
    mesh->normal_count = mesh->triangle_count;
    mesh->normal_indices = f.indices;
    return true;
}
