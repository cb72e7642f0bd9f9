// outlines.c: closes the outlines that a plane leaves in the objects of a scene.
//
// The edges of each part form closed loops if the part is closed; the edges of the other parts of an object are joined,
// as one body may have several materials. A loop lies in the smallest loop around it. The region between a loop and the
// loops in it belongs to the innermost part whose loops wind around it (the nonzero rule of slicers), so solids that
// overlap are counted once, and a cavity stays empty.
#include "outlines.h"

#include "fail.h"
#include "linear.h"

#include <stdlib.h>
#include <string.h>

// Points of an object up to this distance are one vertex, as a fraction of the extent of all outlines. Files with rounded
// numbers leave such gaps.
#define JOIN_DISTANCE 1e-5
enum { CHECK_INTERVAL = 1024 };

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
    const int64_t column = (int64_t)((v.x - o->low[0]) / near), row = (int64_t)((v.y - o->low[1]) / near);
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
    bool finite = true;
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (int i = 0; i < count; i++) {
        most += o->objects[i].cut.edge_count;
        for (uint32_t k = 0; k < o->objects[i].cut.point_count; k++) {
            const struct vertex v = place(o, i, k);
            finite &= math_finite(v.x) && math_finite(v.y);
            low[0] = v.x < low[0] ? v.x : low[0];
            low[1] = v.y < low[1] ? v.y : low[1];
            high[0] = v.x > high[0] ? v.x : high[0];
            high[1] = v.y > high[1] ? v.y : high[1];
        }
    }
    o->size = high[0] - low[0] > high[1] - low[1] ? high[0] - low[0] : high[1] - low[1];
    memcpy(o->low, low, sizeof low);
    if (!finite || (most && !math_finite(o->size))) { // a vertex of a huge transform is infinitely far away
        o->result->open++;
        return true;
    }
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

// Horizontal bands of the plane, each with the loops that reach into it, in their order.
struct bands {
    size_t *first; // of each band in `loops`; one more for the end
    uint32_t *loops;
    uint32_t count;
};

static uint32_t band_at(const struct outlines *o, const struct bands *bands, double y)
{
    const double at = (y - o->low[1]) / o->size * bands->count;
    return at >= bands->count ? bands->count - 1 : at > 0 ? (uint32_t)at : 0;
}

// Fills the bands: about as many as the root of the number of loops, fewer if the loops reach into many.
static bool make_bands(const struct outlines *o, struct bands *bands)
{
    size_t total;
    for (bands->count = 1; bands->count < 4096 && (size_t)bands->count * bands->count < o->loop_count;)
        bands->count *= 2;
    for (;; bands->count /= 2) {
        total = 0;
        for (uint32_t i = 0; i < o->loop_count; i++)
            total += band_at(o, bands, o->loops[i].high_y) - band_at(o, bands, o->loops[i].low_y) + 1;
        if (bands->count == 1 || total <= 16 * (size_t)o->loop_count)
            break;
    }
    bands->first = arena_alloc_zeroed(o->scratch, ((size_t)bands->count + 2) * sizeof *bands->first);
    bands->loops = arena_array(o->scratch, total, sizeof *bands->loops);
    if (!bands->first || !bands->loops)
        return no_memory(o, total * sizeof *bands->loops);
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < o->loop_count; i++)
            for (uint32_t k = band_at(o, bands, o->loops[i].low_y); k <= band_at(o, bands, o->loops[i].high_y); k++)
                if (pass)
                    bands->loops[bands->first[k + 1]++] = i;
                else
                    bands->first[k + 2]++;
        for (uint32_t k = 1; !pass && k <= bands->count + 1; k++)
            bands->first[k] += bands->first[k - 1];
    }
    return true;
}

// Finds the smallest loop around a loop: the last of those before it in its band.
static int parent_of(const struct outlines *o, const struct bands *bands, uint32_t index)
{
    const struct loop *loop = &o->loops[index];
    const uint32_t band = band_at(o, bands, loop->y);
    for (size_t i = bands->first[band + 1]; i-- > bands->first[band];)
        if (bands->loops[i] < index && contains(o, &o->loops[bands->loops[i]], loop->x, loop->y))
            return (int)bands->loops[i];
    return -1;
}

static bool nest_loops(struct outlines *o)
{
    struct bands bands;
    qsort(o->loops, o->loop_count, sizeof *o->loops, by_size);
    if (!make_bands(o, &bands))
        return false;
    for (uint32_t i = 0; i < o->loop_count; i++) {
        struct loop *loop = &o->loops[i];
        if (!find_inside(o, loop))
            return false;
        loop->parent = parent_of(o, &bands, i);
        loop->owner = owner_of(o, loop);
        if (i % CHECK_INTERVAL == 0 && !call_should_continue(o->call))
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
    bool ok = find_edges(&o, count) && find_loops(&o) && nest_loops(&o) && regions_fill(&o);
    triangulator_stop(&o.triangulator);
    arena_free(&scratch);
    return ok;
}
