// outlines.c: closes the outlines that a plane leaves in the objects of a scene.
//
// The edges of each part form closed loops if the part is closed; the edges of the other parts of an object are joined,
// as one body may have several materials. A loop lies in the smallest loop around it. The region between a loop and the
// loops in it belongs to the innermost part whose loops wind around it (the nonzero rule of slicers), so solids that
// overlap are counted once, and a cavity stays empty.
#include "section.h"

#include "fail.h"
#include "linear.h"
#include "triangulate.h"

#include <stdlib.h>
#include <string.h>

// Points of an object up to this distance are one vertex, as a fraction of the extent of all outlines. Files with rounded
// numbers leave such gaps.
#define JOIN_DISTANCE 1e-5
enum { NONE = UINT32_MAX, CHECK_INTERVAL = 1024 };

struct vertex {
    double x, y;    // in the plane
    uint32_t point; // of the object's mesh_cut.points
    int object;     // index in outlines.objects
    uint32_t first; // the first edge that starts here
    uint32_t next;  // in its slot of the hash table
    int balance;
};

struct edge {
    uint32_t a, b;  // vertices
    uint32_t next;  // the next edge that starts at `a`
    uint32_t after; // the next edge of the loop
    uint32_t part, group;
    int object;
    bool used;
};

struct loop {
    uint32_t first, count; // edges, linked by edge.after
    double area;           // signed; counter-clockwise is positive
    double low_x, low_y, high_x, high_y;
    double x, y;              // a point inside
    int parent;               // the smallest loop around it, or −1
    const struct edge *owner; // an edge of the part that the region in the loop belongs to; NULL for a cavity
};

struct outlines {
    struct cut_object *objects;
    lam_vec3 origin, across, upward; // of the plane: across × upward is the normal
    struct vertex *vertices;
    struct edge *edges;
    uint32_t vertex_count, edge_count, groups;
    struct loop *loops;
    uint32_t loop_count;
    double size;           // the larger extent
    uint32_t *table, mask; // hash table of the vertices
    struct arena *scratch, *memory;
    struct triangulator triangulator;
    struct outline_result *result;
    struct call_control *call;
    lam_error *error;
};

static bool no_memory(struct outlines *o, size_t bytes) { return call_memory_error(o->call, bytes, o->error); }

static void set_axes(struct outlines *o, const lam_section *plane)
{
    const lam_vec3 n = plane->normal;
    const double x = n.x < 0 ? -n.x : n.x, y = n.y < 0 ? -n.y : n.y, z = n.z < 0 ? -n.z : n.z;
    const lam_vec3 other = x <= y && x <= z ? v3(1, 0, 0) : y <= z ? v3(0, 1, 0) : v3(0, 0, 1);
    o->across = v3_unit(v3_cross(other, n));
    o->upward = v3_cross(n, o->across);
    o->origin = v3_scale(n, plane->distance);
}

// --- vertices and edges

static struct vertex place(const struct outlines *o, int object, uint32_t point)
{
    const struct cut_object *of = &o->objects[object];
    const float *p = of->cut.points[point].position;
    const lam_vec3 at = v3_sub(mat4_point(&of->to_world, v3((double)p[0], (double)p[1], (double)p[2])), o->origin);
    return (struct vertex){v3_dot(at, o->across), v3_dot(at, o->upward), point, object, NONE, NONE, 0};
}

static uint32_t slot_of(const struct outlines *o, int64_t column, int64_t row)
{
    return (uint32_t)(((uint64_t)column * 0x9e3779b97f4a7c15u + (uint64_t)row * 0xc2b2ae3d27d4eb4fu) >> 32) & o->mask;
}

// Returns the vertex at a point of an object, or the nearest vertex of this object that is close to the point.
static uint32_t vertex_at(struct outlines *o, int object, uint32_t point)
{
    const double near = JOIN_DISTANCE * o->size + 1e-300;
    struct vertex v = place(o, object, point);
    const int64_t column = (int64_t)(v.x / near), row = (int64_t)(v.y / near);
    uint32_t best = NONE;
    double least = near * near;
    for (int i = 0; i < 9; i++)
        for (uint32_t k = o->table[slot_of(o, column + i % 3 - 1, row + i / 3 - 1)]; k != NONE;
             k = o->vertices[k].next) {
            const double dx = o->vertices[k].x - v.x, dy = o->vertices[k].y - v.y;
            if (o->vertices[k].object == object && dx * dx + dy * dy < least) {
                least = dx * dx + dy * dy;
                best = k;
            }
        }
    if (best != NONE)
        return best;
    uint32_t *slot = &o->table[slot_of(o, column, row)];
    v.next = *slot;
    o->vertices[o->vertex_count] = v;
    return *slot = o->vertex_count++;
}

// Adds the edges of an object, and gives each closed part a group of its own.
static void add_edges(struct outlines *o, int object)
{
    const struct mesh_cut *cut = &o->objects[object].cut;
    const uint32_t joined = o->groups++;
    for (uint32_t i = 0, end; i < cut->edge_count; i = end) {
        const uint32_t part = cut->edges[i].part, first = o->edge_count;
        bool balanced = true;
        for (end = i; end < cut->edge_count && cut->edges[end].part == part; end++) {
            const uint32_t a = vertex_at(o, object, cut->edges[end].points[0]);
            const uint32_t b = vertex_at(o, object, cut->edges[end].points[1]);
            if (a == b || !o->objects[object].closes[part])
                continue;
            o->vertices[a].balance++;
            o->vertices[b].balance--;
            o->edges[o->edge_count++] = (struct edge){a, b, NONE, NONE, part, joined, object, false};
        }
        for (uint32_t e = first; e < o->edge_count; e++)
            balanced &= !o->vertices[o->edges[e].a].balance && !o->vertices[o->edges[e].b].balance;
        for (uint32_t e = first; e < o->edge_count; e++) {
            o->vertices[o->edges[e].a].balance = o->vertices[o->edges[e].b].balance = 0;
            o->edges[e].group = balanced ? o->groups : joined;
        }
        o->groups += balanced;
    }
}

static bool find_edges(struct outlines *o, int count)
{
    size_t most = 0;
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (int i = 0; i < count; i++) {
        most += o->objects[i].cut.edge_count;
        for (uint32_t k = 0; k < o->objects[i].cut.point_count; k++) {
            const struct vertex v = place(o, i, k);
            low[0] = v.x < low[0] ? v.x : low[0];
            low[1] = v.y < low[1] ? v.y : low[1];
            high[0] = v.x > high[0] ? v.x : high[0];
            high[1] = v.y > high[1] ? v.y : high[1];
        }
    }
    o->size = high[0] - low[0] > high[1] - low[1] ? high[0] - low[0] : high[1] - low[1];
    if (most > UINT32_MAX / 8)
        return fail(o->error, LAM_LIMIT, "a section has more than %u edges", UINT32_MAX / 8);
    while (o->mask < 2 * most)
        o->mask = 2 * o->mask + 1;
    o->table = arena_array(o->scratch, (size_t)o->mask + 1, sizeof *o->table);
    o->vertices = arena_array(o->scratch, 2 * most, sizeof *o->vertices);
    o->edges = arena_array(o->scratch, most, sizeof *o->edges);
    if (!o->table || !o->vertices || !o->edges)
        return no_memory(o, most * 128);
    memset(o->table, 0xff, ((size_t)o->mask + 1) * sizeof *o->table);
    for (int i = 0; i < count; i++)
        add_edges(o, i);
    for (uint32_t i = o->edge_count; i-- > 0;) {
        o->edges[i].next = o->vertices[o->edges[i].a].first;
        o->vertices[o->edges[i].a].first = i;
    }
    return true;
}

// --- loops

// Returns the unused edge that continues another edge: of the same group and, if possible, the same part.
static uint32_t continuation(const struct outlines *o, const struct edge *edge)
{
    uint32_t found = NONE;
    for (uint32_t i = o->vertices[edge->b].first; i != NONE; i = o->edges[i].next) {
        const struct edge *other = &o->edges[i];
        if (other->used || other->group != edge->group)
            continue;
        if (other->part == edge->part)
            return i;
        found = found == NONE ? i : found;
    }
    return found;
}

static void add_loop(struct outlines *o, uint32_t first)
{
    struct loop loop = {.first = first, .low_x = 1e300, .low_y = 1e300, .high_x = -1e300, .high_y = -1e300};
    const struct vertex *start = &o->vertices[o->edges[first].a];
    uint32_t i = first;
    do {
        const struct vertex *a = &o->vertices[o->edges[i].a], *b = &o->vertices[o->edges[o->edges[i].after].a];
        loop.area += 0.5 * ((a->x - start->x) * (b->y - start->y) - (b->x - start->x) * (a->y - start->y));
        loop.low_x = a->x < loop.low_x ? a->x : loop.low_x;
        loop.low_y = a->y < loop.low_y ? a->y : loop.low_y;
        loop.high_x = a->x > loop.high_x ? a->x : loop.high_x;
        loop.high_y = a->y > loop.high_y ? a->y : loop.high_y;
        loop.count++;
        i = o->edges[i].after;
    } while (i != first);
    const double area = loop.area < 0 ? -loop.area : loop.area;
    if (area > 1e-14 * o->size * o->size)
        o->loops[o->loop_count++] = loop;
}

// Follows the edges to closed loops. Outlines that do not close are counted.
static bool find_loops(struct outlines *o)
{
    o->loops = arena_array(o->scratch, o->edge_count, sizeof *o->loops);
    if (!o->loops)
        return no_memory(o, o->edge_count * sizeof *o->loops);
    for (uint32_t i = 0; i < o->edge_count; i++) {
        if (o->edges[i].used)
            continue;
        uint32_t last = i;
        for (o->edges[i].used = true; last != NONE && o->edges[last].b != o->edges[i].a; last = o->edges[last].after)
            if ((o->edges[last].after = continuation(o, &o->edges[last])) != NONE)
                o->edges[o->edges[last].after].used = true;
        if (last == NONE) {
            o->result->open++;
            continue;
        }
        o->edges[last].after = i;
        add_loop(o, i);
    }
    return true;
}

// --- which loop is in which

static int by_number(const void *a, const void *b)
{
    return *(const double *)a < *(const double *)b ? -1 : *(const double *)a > *(const double *)b;
}

// Finds a point inside a loop: on a line between the vertices, in the widest part.
static bool find_inside(struct outlines *o, struct loop *loop)
{
    double *numbers = malloc(loop->count * sizeof *numbers), gap = 0, widest = 0;
    uint32_t count = 0;
    if (!numbers)
        return no_memory(o, loop->count * sizeof *numbers);
    for (uint32_t i = loop->first; count < loop->count; i = o->edges[i].after)
        numbers[count++] = o->vertices[o->edges[i].a].y;
    qsort(numbers, count, sizeof *numbers, by_number);
    for (uint32_t i = 0; i + 1 < count; i++)
        if (numbers[i + 1] - numbers[i] > gap) {
            gap = numbers[i + 1] - numbers[i];
            loop->y = 0.5 * (numbers[i + 1] + numbers[i]);
        }
    uint32_t crossings = 0, i = loop->first;
    do {
        const struct vertex *a = &o->vertices[o->edges[i].a], *b = &o->vertices[o->edges[o->edges[i].after].a];
        if ((a->y > loop->y) != (b->y > loop->y))
            numbers[crossings++] = a->x + (loop->y - a->y) / (b->y - a->y) * (b->x - a->x);
        i = o->edges[i].after;
    } while (i != loop->first);
    qsort(numbers, crossings, sizeof *numbers, by_number);
    for (uint32_t k = 0; k + 1 < crossings; k += 2)
        if (numbers[k + 1] - numbers[k] > widest) {
            widest = numbers[k + 1] - numbers[k];
            loop->x = 0.5 * (numbers[k + 1] + numbers[k]);
        }
    free(numbers);
    return true;
}

static bool contains(const struct outlines *o, const struct loop *loop, double x, double y)
{
    bool inside = false;
    uint32_t i = loop->first;
    if (x < loop->low_x || x > loop->high_x || y < loop->low_y || y > loop->high_y)
        return false;
    do {
        const struct vertex *a = &o->vertices[o->edges[i].a], *b = &o->vertices[o->edges[o->edges[i].after].a];
        if ((a->y > y) != (b->y > y) && x < a->x + (y - a->y) / (b->y - a->y) * (b->x - a->x))
            inside = !inside;
        i = o->edges[i].after;
    } while (i != loop->first);
    return inside;
}

static double size_of(const struct loop *loop) { return loop->area < 0 ? -loop->area : loop->area; }

static int by_size(const void *a, const void *b)
{
    const struct loop *x = a, *y = b;
    const double difference = size_of(y) - size_of(x);
    return difference < 0 ? -1 : difference > 0 ? 1 : x->first < y->first ? -1 : 1;
}

// Finds the part that the region directly in a loop belongs to.
static const struct edge *owner_of(const struct outlines *o, const struct loop *loop)
{
    for (const struct loop *at = loop;; at = &o->loops[at->parent]) {
        const struct edge *edge = &o->edges[at->first];
        int winding = 0;
        for (const struct loop *around = loop;; around = &o->loops[around->parent]) {
            if (o->edges[around->first].group == edge->group)
                winding += around->area > 0 ? 1 : -1;
            if (around->parent < 0)
                break;
        }
        if (winding)
            return edge;
        if (at->parent < 0)
            return NULL;
    }
}

static bool nest_loops(struct outlines *o)
{
    qsort(o->loops, o->loop_count, sizeof *o->loops, by_size);
    for (uint32_t i = 0; i < o->loop_count; i++) {
        struct loop *loop = &o->loops[i];
        if (!find_inside(o, loop))
            return false;
        loop->parent = (int)i - 1;
        while (loop->parent >= 0 && !contains(o, &o->loops[loop->parent], loop->x, loop->y))
            loop->parent--;
        loop->owner = owner_of(o, loop);
        if (i % CHECK_INTERVAL == 0 && !call_should_continue(o->call))
            return call_error(o->call, o->error);
    }
    return true;
}

// --- cut surfaces

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

static bool fill(struct outlines *o)
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

bool outlines_close(struct cut_object *objects, int count, const lam_section *plane, struct arena *memory,
                    struct outline_result *result, struct call_control *call, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, call);
    struct outlines o = {
        .objects = objects, .scratch = &scratch, .memory = memory, .result = result, .call = call, .error = error};
    set_axes(&o, plane);
    triangulator_start(&o.triangulator, call);
    bool ok = find_edges(&o, count) && find_loops(&o) && nest_loops(&o) && fill(&o);
    triangulator_stop(&o.triangulator);
    arena_free(&scratch);
    return ok;
}
