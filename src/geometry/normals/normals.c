// normals.c: normals for meshes that have none.
//
// Smooth normals, in four steps over the whole mesh. Weld (weld.c): each vertex gets the number of its
// position. Link: each corner is pushed onto its position's list, by one exchange of the list's head, so that
// any number of threads may; the links lie in the array that becomes normal_indices, which saves a quarter of
// the memory. Fans (corner_fan.c): for each position the corners are put in order and their normals worked
// out, in pieces of a fixed number of positions; a corner's index counts within its piece. Shift: the pieces'
// normals are strung together, and each corner's index moved by those before its piece. The lists' order is
// the only thing that depends on the threads, and it is sorted away.
#include "normals.h"

#include "loop_status.h"
#include "linear.h"
#include "corner_fan.h"
#include "weld.h"

#include <stdlib.h>
#include <string.h>

enum {
    CHUNK = 1 << 16, // corners of one piece of work
    PIECE = 1 << 12, // positions of one piece of work
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
    struct loop_status loop;
    size_t corners;
    uint32_t *position_of; // vertex → number of its position
    uint32_t positions;
    uint32_t *heads;        // position → its last pushed corner
    uint32_t *indices;      // corner → the corner pushed before it; then its normal's index
    struct fan_room *rooms; // one for each thread
    struct piece *pieces;
    float (*normals)[3];
    uint32_t normal_count;
};

static size_t chunks_of(size_t total) { return (total + CHUNK - 1) / CHUNK; }

static size_t chunk_end(size_t index, size_t total)
{
    size_t end = (index + 1) * CHUNK;
    return end < total ? end : total;
}

// --- Link

#define NO_CORNER UINT32_MAX

static void link_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    if (!should_continue(&s->loop))
        return;
    for (size_t c = index * CHUNK; c < chunk_end(index, s->corners); c++) {
        uint32_t position = s->position_of[corner_vertex(s->mesh, c)];
        s->indices[c] = __atomic_exchange_n(&s->heads[position], (uint32_t)c, __ATOMIC_RELAXED);
    }
}

// --- Fans

// The list was pushed in nearly ascending order, so it is read in nearly descending order.
static void sort_corners(uint32_t *corners, uint32_t count)
{
    for (uint32_t i = 0, j = count - 1; i < j; i++, j--) {
        uint32_t swap = corners[i];
        corners[i] = corners[j];
        corners[j] = swap;
    }
    fan_sort(corners, count);
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
    if (!should_continue(&s->loop))
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
            no_memory(&s->loop);
            return;
        }
        uint32_t fans = count ? fan_normals(s->mesh, s->least_cosine, room, count) : 0;
        if (piece->count + fans > held) {
            // At first one normal for each position, which is most often what is needed.
            uint32_t larger = held ? 2 * held : (uint32_t)(end - first);
            larger = larger < piece->count + fans ? piece->count + fans : larger;
            float(*copy)[3] = arena_array(arena, larger, sizeof *copy);
            if (!copy) {
                no_memory(&s->loop);
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

// --- Shift

static void shift_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct smoothing *s = user;
    if (!should_continue(&s->loop))
        return;
    for (size_t c = index * CHUNK; c < chunk_end(index, s->corners); c++)
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

// Fans and shift, with the normals in `arena`.
static bool make_fans(struct smoothing *s, struct arena *arena)
{
    int threads = pool_threads(s->pool);
    size_t pieces = (s->positions + (size_t)PIECE - 1) / PIECE;
    s->pieces = arena_alloc_zeroed(s->scratch, pieces * sizeof *s->pieces);
    s->rooms = arena_array(s->scratch, (size_t)threads, sizeof *s->rooms);
    if (!s->pieces || !s->rooms) {
        no_memory(&s->loop);
        return false;
    }
    for (int i = 0; i < threads; i++)
        fan_room_start(&s->rooms[i], s->loop.call);
    pool_run(s->pool, pieces, fan_piece, s);
    uint64_t total = 0; // at most one for each corner, and there are fewer than 2³² of those
    for (size_t i = 0; i < pieces; i++) {
        s->pieces[i].before = (uint32_t)total;
        total += s->pieces[i].count;
    }
    if (should_continue(&s->loop)) {
        s->normals = arena_array(arena, total, sizeof *s->normals);
        if (s->normals) {
            pool_run(s->pool, pieces, copy_piece, s);
            pool_run(s->pool, chunks_of(s->corners), shift_chunk, s);
            s->normal_count = (uint32_t)total;
        } else
            no_memory(&s->loop);
    }
    for (int i = 0; i < threads; i++)
        fan_room_free(&s->rooms[i]);
    return should_continue(&s->loop);
}

bool normals_smooth(lam_mesh *mesh, double crease_angle_rad, struct arena *arena, struct pool *pool,
                    struct call_control *call, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, call);
    struct smoothing s = {
        .mesh = mesh,
        .least_cosine = fan_least_cosine(crease_angle_rad),
        .scratch = &scratch,
        .pool = pool,
        .loop = {.call = call},
        .corners = (size_t)mesh->triangle_count * 3,
    };
    size_t vertices = mesh->indices ? mesh->vertex_count : s.corners;
    s.indices = arena_array(arena, s.corners, sizeof *s.indices);
    s.position_of = arena_array(&scratch, vertices, sizeof *s.position_of);
    bool ok = s.indices && s.position_of;
    if (!ok)
        call_memory_error(call, (s.corners + vertices) * 4, error);
    ok = ok && weld_positions(mesh->positions, vertices, s.position_of, &s.positions, pool, call, error);
    if (ok) {
        s.heads = arena_array(&scratch, s.positions, sizeof *s.heads);
        if (s.heads) {
            memset(s.heads, 0xff, s.positions * sizeof *s.heads);
            pool_run(pool, chunks_of(s.corners), link_chunk, &s);
        } else
            no_memory(&s.loop);
        ok = (should_continue(&s.loop) && make_fans(&s, arena)) || loop_error(&s.loop, s.corners * 4, error);
    }
    if (ok) {
        mesh->normals = &s.normals[0][0];
        mesh->normal_count = s.normal_count;
        mesh->normal_indices = s.indices;
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
