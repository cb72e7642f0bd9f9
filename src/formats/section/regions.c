// regions.c: fills the regions between outlines with triangles: the cut surfaces.
#include "outlines.h"

#include "fail.h"
#include "linear.h"

#include <stdlib.h>
#include <string.h>

// A polygon: the vertices of a loop and of the loops in it, joined by bridges.
struct ring {
    uint32_t *vertices;
    bool *bridge; // whether the edge after the vertex is a bridge
    uint32_t count;
};

static void add_ring(const struct outlines *o, const struct loop *loop, bool positive, uint32_t *out)
{
    uint32_t n = 0;
    for (uint32_t i = loop->first; n < loop->count; i = o->edges[i].after, n++)
        out[(loop->area > 0) == positive ? n : loop->count - 1 - n] = o->edges[i].a;
}

static double turn(const struct vertex *a, const struct vertex *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

// Returns the corner of the ring to which a hole's corner m, its rightmost, can be joined (D. Eberly, "Triangulation by
// Ear Clipping", 2002): an end of the edge that is hit by a ray to the right, or a corner before it.
static uint32_t visible_corner(const struct outlines *o, const struct ring *ring, const struct vertex *m)
{
    uint32_t best = 0;
    double nearest = 1e300;
    for (uint32_t i = 0; i < ring->count; i++) {
        const uint32_t next = i + 1 < ring->count ? i + 1 : 0;
        const struct vertex *a = &o->vertices[ring->vertices[i]], *b = &o->vertices[ring->vertices[next]];
        if (!(a->y <= m->y && b->y >= m->y) || a->y == b->y)
            continue; // the inside is on the left of edges that go up
        const double x = a->x + (m->y - a->y) / (b->y - a->y) * (b->x - a->x);
        if (x >= m->x && x < nearest) {
            nearest = x;
            best = a->y == m->y ? i : b->y == m->y ? next : a->x > b->x ? i : next;
        }
    }
    const struct vertex *p = &o->vertices[ring->vertices[best]];
    if (p->y == m->y)
        return best;
    // Corners in the triangle m, hit, p may hide p; the one nearest to the ray is visible.
    const struct vertex hit = {.x = nearest, .y = m->y};
    const double side = p->y > m->y ? 1 : -1;
    double least = 1e300;
    uint32_t visible = best;
    for (uint32_t i = 0; i < ring->count; i++) {
        const struct vertex *v = &o->vertices[ring->vertices[i]];
        if (i == best || v->x < m->x || (v->x == p->x && v->y == p->y) || side * (v->y - m->y) < 0 ||
            side * turn(&hit, p, v->x, v->y) < 0 || side * turn(p, m, v->x, v->y) < 0)
            continue;
        const double slope = side * (v->y - m->y) / (v->x > m->x ? v->x - m->x : 1e-300);
        if (slope < least || (slope == least && v->x < o->vertices[ring->vertices[visible]].x)) {
            least = slope;
            visible = i;
        }
    }
    return visible;
}

// Inserts a hole, whose vertices run clockwise, into the ring.
static void add_hole(const struct outlines *o, const struct loop *hole, struct ring *ring, uint32_t *scratch)
{
    uint32_t right = 0;
    add_ring(o, hole, false, scratch);
    for (uint32_t i = 1; i < hole->count; i++)
        if (o->vertices[scratch[i]].x > o->vertices[scratch[right]].x)
            right = i;
    const uint32_t at = visible_corner(o, ring, &o->vertices[scratch[right]]), added = hole->count + 2;
    memmove(ring->vertices + at + 1 + added, ring->vertices + at + 1, (ring->count - at - 1) * sizeof *ring->vertices);
    memmove(ring->bridge + at + 1 + added, ring->bridge + at + 1, ring->count - at - 1);
    for (uint32_t i = 0; i <= hole->count; i++) {
        ring->vertices[at + 1 + i] = scratch[(right + i) % hole->count];
        ring->bridge[at + 1 + i] = i == hole->count;
    }
    ring->vertices[at + added] = ring->vertices[at];
    ring->bridge[at + added] = ring->bridge[at];
    ring->bridge[at] = true;
    ring->count += added;
}

// Returns the point of an object's mesh at a vertex, which may come from another object.
static uint32_t point_of(struct outlines *o, struct cut_object *object, uint32_t index)
{
    const struct vertex *v = &o->vertices[index];
    struct mesh_cut *cut = &object->cut;
    if (&o->objects[v->object] == object)
        return v->point;
    if (cut->point_count == cut->point_capacity) {
        struct cut_point *points = arena_array(o->memory, 2 * (size_t)cut->point_capacity, sizeof *points);
        if (!points)
            return NONE;
        memcpy(points, cut->points, cut->point_count * sizeof *points);
        cut->points = points;
        cut->point_capacity *= 2;
    }
    lam_mat4 to_mesh;
    const lam_vec3 world = v3_add(o->origin, v3_add(v3_scale(o->across, v->x), v3_scale(o->upward, v->y)));
    mat4_inverse_affine(&object->to_world, &to_mesh);
    const lam_vec3 at = mat4_point(&to_mesh, world);
    cut->points[cut->point_count] = cut->points[0];
    const float position[3] = {(float)at.x, (float)at.y, (float)at.z};
    memcpy(cut->points[cut->point_count].position, position, sizeof position);
    return cut->point_count++;
}

// Returns the part of a joined outline with the longest edges.
static uint32_t main_part(const struct outlines *o, const struct edge *owner)
{
    const struct edge *edge = owner;
    uint32_t best = owner->part;
    double longest = 0, length = 0;
    do { // edges of one part follow each other
        const struct edge *next = &o->edges[edge->after];
        const double dx = o->vertices[next->a].x - o->vertices[edge->a].x,
                     dy = o->vertices[next->a].y - o->vertices[edge->a].y;
        length += math_sqrt(dx * dx + dy * dy);
        if (length > longest) {
            longest = length;
            best = edge->part;
        }
        length = next->part == edge->part ? length : 0;
        edge = next;
    } while (edge != owner);
    return best;
}

static bool add_triangles(struct outlines *o, const struct loop *loop, const struct ring *ring, const uint32_t *triples)
{
    struct cut_object *object = &o->objects[loop->owner->object];
    struct cap_triangles *caps = &object->cut.caps[main_part(o, loop->owner)];
    const size_t count = ring->count - 2;
    if (caps->count + count > caps->capacity) {
        const size_t capacity = (caps->count + count) * 2;
        uint32_t *points = arena_array(o->memory, capacity, 3 * sizeof *points);
        uint8_t *inner = arena_array(o->memory, capacity, 1);
        if (!points || !inner || capacity > UINT32_MAX / 3)
            return no_memory(o, capacity * 12);
        if (caps->count) {
            memcpy(points, caps->points, (size_t)caps->count * 3 * sizeof *points);
            memcpy(inner, caps->inner, caps->count);
        }
        *caps = (struct cap_triangles){points, inner, caps->count, (uint32_t)capacity};
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t *t = triples + 3 * i;
        uint8_t inner = triangulated_inner_edges(t, ring->count) | 8;
        for (int k = 0; k < 3; k++) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            const uint32_t earlier = (a + 1) % ring->count == b ? a : b;
            inner |= (uint8_t)(ring->bridge[earlier] << k);
            const uint32_t point = point_of(o, object, ring->vertices[a]);
            if (point == NONE)
                return no_memory(o, 64);
            caps->points[3 * (size_t)caps->count + (size_t)k] = point;
        }
        caps->inner[caps->count++] = inner;
    }
    return true;
}

static int by_right_end(const void *a, const void *b)
{
    const struct loop *x = *(const struct loop *const *)a, *y = *(const struct loop *const *)b;
    return x->high_x > y->high_x ? -1 : x->high_x < y->high_x ? 1 : x < y ? -1 : 1;
}

// Fills the region between a loop and the `count` loops directly in it, sorted by their right ends.
static bool fill_region(struct outlines *o, const struct loop *loop, const struct loop **holes, uint32_t count)
{
    size_t most = loop->count;
    for (uint32_t i = 0; i < count; i++)
        most += (size_t)holes[i]->count + 2;
    struct {
        uint32_t ring, scratch, corner, triples[3];
        float position[3];
        bool bridge;
    } *unit;
    char *block = malloc(most * sizeof *unit + 64);
    if (!block || most > UINT32_MAX / 4) {
        free(block);
        return no_memory(o, most * sizeof *unit);
    }
    uint32_t *scratch = (uint32_t *)(void *)block, *corners = scratch + most, *triples = corners + most;
    struct ring ring = {.vertices = triples + 3 * most, .count = loop->count};
    float *positions = (float *)(ring.vertices + most);
    ring.bridge = (bool *)(positions + 3 * most);
    memset(ring.bridge, 0, most);
    add_ring(o, loop, true, ring.vertices);
    o->result->area += size_of(loop);
    for (uint32_t i = 0; i < count; i++) {
        if (!call_should_continue(o->call)) {
            free(block);
            return call_error(o->call, o->error);
        }
        add_hole(o, holes[i], &ring, scratch);
        o->result->area -= size_of(holes[i]);
    }
    for (uint32_t i = 0; i < ring.count; i++) {
        const struct vertex *v = &o->vertices[ring.vertices[i]];
        corners[i] = i;
        positions[3 * i] = (float)(v->x - loop->low_x);
        positions[3 * i + 1] = (float)(v->y - loop->low_y);
        positions[3 * i + 2] = 0;
    }
    bool ok = triangulate(&o->triangulator, positions, corners, ring.count, triples) ||
              (call_should_continue(o->call) ? no_memory(o, most * sizeof *unit) : call_error(o->call, o->error));
    ok = ok && add_triangles(o, loop, &ring, triples);
    free(block);
    return ok;
}

bool regions_fill(struct outlines *o)
{
    const struct loop **holes = arena_array(o->scratch, o->loop_count, sizeof *holes);
    uint32_t *first = arena_alloc_zeroed(o->scratch, ((size_t)o->loop_count + 2) * sizeof *first);
    if (!holes || !first)
        return no_memory(o, o->loop_count * sizeof *holes);
    for (uint32_t i = 0; i < o->loop_count; i++) // loops without a parent come first
        first[o->loops[i].parent + 2]++;
    for (uint32_t i = 1; i <= o->loop_count; i++)
        first[i] += first[i - 1];
    for (uint32_t i = 0; i < o->loop_count; i++)
        holes[first[o->loops[i].parent + 1]++] = &o->loops[i];
    for (uint32_t i = 0; i < o->loop_count; i++) {
        const struct loop *loop = &o->loops[i];
        const uint32_t begin = first[i], count = first[i + 1] - begin;
        if (!loop->owner)
            continue;
        qsort(holes + begin, count, sizeof *holes, by_right_end);
        if (!fill_region(o, loop, holes + begin, count))
            return false;
        if (!call_should_continue(o->call))
            return call_error(o->call, o->error);
    }
    return true;
}
