// corner_fan.c: computes the normals at one position from the corners that meet there.
#include "corner_fan.h"
#include "angle_series.h"
#include "cpu_features.h"
#include "linear.h"
#include "positions.h"

#include <stdlib.h>
#include <string.h>

// One of the two triangle edges that meet in a corner.
struct fan_edge {
    uint32_t end[3]; // bits of the position of the edge's other end
    uint32_t corner;
    uint32_t incoming; // 0: the triangle's edge starts at the position; 1: the edge ends at the position
};
_Static_assert(2 * sizeof(struct fan_edge) >= 3 * sizeof(double),
               "the memory of a corner's two edges must be large enough for a fan's sum of normals");

// Tolerance for the rounding of float positions: equal angles between faces may differ in the seventh digit.
#define CREASE_SLACK 1e-6

double min_crease_cosine(double crease_angle_rad) { return math_cos(crease_angle_rad) - CREASE_SLACK; }

static int compare_corners(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

void sort_corners(uint32_t *corners, uint32_t count)
{
    if (count > 64) {
        bool sorted = true;
        for (uint32_t i = 1; i < count; i++)
            sorted &= corners[i - 1] < corners[i];
        if (!sorted)
            qsort(corners, count, sizeof *corners, compare_corners);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        uint32_t corner = corners[i], j = i;
        for (; j > 0 && corners[j - 1] > corner; j--)
            corners[j] = corners[j - 1];
        corners[j] = corner;
    }
}

void corner_fan_scratch_start(struct corner_fan_scratch *scratch, struct call_control *call)
{
    *scratch = (struct corner_fan_scratch){0};
    arena_start(&scratch->arena, call);
}

void corner_fan_scratch_free(struct corner_fan_scratch *scratch) { arena_free(&scratch->arena); }

bool corner_fan_scratch_reserve(struct corner_fan_scratch *scratch, uint32_t count)
{
    if (count <= scratch->capacity)
        return true;
    uint32_t larger = scratch->capacity ? scratch->capacity : 64;
    while (larger < count)
        larger = larger > UINT32_MAX / 2 ? count : larger * 2;
    scratch->numbers = arena_array(&scratch->arena, larger, sizeof *scratch->numbers);
    scratch->corners = arena_array(&scratch->arena, larger, sizeof *scratch->corners);
    scratch->edges = arena_array(&scratch->arena, 2 * (size_t)larger, sizeof *scratch->edges);
    scratch->normals = arena_array(&scratch->arena, larger, sizeof *scratch->normals);
    bool ok = scratch->numbers && scratch->corners && scratch->edges && scratch->normals;
    scratch->capacity = ok ? larger : 0;
    return ok;
}

// Returns atan2(y, x) for y ≥ 0.
static double angle_of(double y, double x)
{
    double ax = x < 0 ? -x : x;
    bool steep = y > ax;
    double larger = steep ? y : ax;
    if (!(larger > 0))
        return 0;
    double t = (steep ? ax : y) / larger, z = t * t;
    double a = ANGLE_SERIES(t, z);
    if (steep)
        a = PI / 2 - a;
    return x < 0 ? PI - a : a;
}

static void look(const lam_mesh *mesh, uint32_t corner, struct fan_corner *c)
{
    uint32_t triangle = corner / 3, k = corner - 3 * triangle;
    uint32_t next = k == 2 ? corner - 2 : corner + 1, previous = k == 0 ? corner + 2 : corner - 1;
    const float *p = mesh->positions + 3 * (size_t)corner_vertex(mesh, corner);
    const float *q = mesh->positions + 3 * (size_t)corner_vertex(mesh, next);
    const float *r = mesh->positions + 3 * (size_t)corner_vertex(mesh, previous);
    c->corner = corner;
    c->smoothing_group = mesh->smoothing_groups ? mesh->smoothing_groups[triangle] : 1;
    position_bits(q, c->next);
    position_bits(r, c->previous);
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)q[i] - (double)p[i];
        b[i] = (double)r[i] - (double)p[i];
    }
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    // The length is twice the triangle's area. Differences of floats are at most 7e38, so the square of the length is
    // below 1e156, and above 1e-180 if it is not 0.
    double length = __builtin_sqrt(x * x + y * y + z * z);
    bool spans = length > 0 && length < 1e300; // neither infinite nor NaN
    double scale = spans ? 1 / length : 0;
    c->normal[0] = spans ? x * scale : 0;
    c->normal[1] = spans ? y * scale : 0;
    c->normal[2] = spans ? z * scale : 0;
    // |a × b| is |a| |b| times the sine of the angle, and a·b is |a| |b| times its cosine. The weight is below 1e78,
    // and above 1e-90 if it is not 0, so neither a sum of weighted normals nor its square overflows or underflows,
    // regardless of the unit.
    c->weight = spans ? length * angle_of(length, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) : 0;
}

static bool has_area(const struct fan_corner *s) { return s->normal[0] != 0 || s->normal[1] != 0 || s->normal[2] != 0; }

static uint32_t root_of(struct fan_corner *around, uint32_t i)
{
    while (around[i].fan != i) {
        around[i].fan = around[around[i].fan].fan; // path halving
        i = around[i].fan;
    }
    return i;
}

// Joins two corners that share an edge, if they may also share a normal. The corner with the lower index becomes the
// root.
static void join(struct fan_corner *around, uint32_t a, uint32_t b, double min_cosine)
{
    const struct fan_corner *s = &around[a], *t = &around[b];
    double cosine = s->normal[0] * t->normal[0] + s->normal[1] * t->normal[1] + s->normal[2] * t->normal[2];
    if (!(cosine >= min_cosine) || s->smoothing_group != t->smoothing_group || s->smoothing_group == 0 ||
        !has_area(s) || !has_area(t))
        return;
    uint32_t x = root_of(around, a), y = root_of(around, b);
    if (x < y)
        around[y].fan = x;
    else
        around[x].fan = y;
}

// Neighbours with consistent winding traverse their common edge in opposite directions: one triangle's next corner is
// the other triangle's previous corner. This function tests every pair, so it is called only for few corners.
static void join_few(struct fan_corner *around, uint32_t count, double min_cosine)
{
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < count; j++)
            if (same_position(around[i].next, around[j].previous) && i != j)
                join(around, i, j, min_cosine);
}

static int compare_edges(const void *left, const void *right)
{
    const struct fan_edge *a = left, *b = right;
    for (int i = 0; i < 3; i++)
        if (a->end[i] != b->end[i])
            return a->end[i] < b->end[i] ? -1 : 1;
    if (a->incoming != b->incoming)
        return a->incoming < b->incoming ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

// Joins many corners, after sorting their edges. If very many triangles share an edge, there are too many pairs of
// corners. Each outgoing edge is then tested only against the incoming edge of the same rank. No real surface has such
// an edge.
static void join_many(struct fan_corner *around, struct fan_edge *edges, uint32_t count, double min_cosine)
{
    enum { PAIRS_MAX = 256 };
    for (uint32_t i = 0; i < count; i++) {
        memcpy(edges[2 * (size_t)i].end, around[i].next, 12);
        memcpy(edges[2 * (size_t)i + 1].end, around[i].previous, 12);
        for (uint32_t k = 0; k < 2; k++) {
            edges[2 * (size_t)i + k].corner = i;
            edges[2 * (size_t)i + k].incoming = k;
        }
    }
    size_t total = 2 * (size_t)count;
    qsort(edges, total, sizeof *edges,
          compare_edges); // no two edges are equal, so the order does not depend on qsort
    for (size_t first = 0; first < total;) {
        size_t split = first, end;
        while (split < total && !edges[split].incoming && same_position(edges[split].end, edges[first].end))
            split++;
        for (end = split; end < total && edges[end].incoming && same_position(edges[end].end, edges[first].end);)
            end++;
        size_t out = split - first, in = end - split;
        bool all = out <= PAIRS_MAX && in <= PAIRS_MAX && out * in <= PAIRS_MAX;
        for (size_t i = 0; i < out; i++)
            for (size_t j = all ? 0 : i; j < (all || i >= in ? in : i + 1); j++)
                if (edges[first + i].corner != edges[split + j].corner)
                    join(around, edges[first + i].corner, edges[split + j].corner, min_cosine);
        first = end;
    }
}

// Returns the fan for a corner of a degenerate triangle: the fan of the first non-degenerate triangle that shares an
// edge with this triangle. Returns the fan of corner `otherwise` if there is no such triangle.
static uint32_t neighbouring_fan(const struct fan_corner *around, uint32_t count, uint32_t i, uint32_t otherwise)
{
    enum { EXAMINED_MAX = 64 }; // limits the time for a million such corners at one position
    for (uint32_t j = 0; j < count && j < EXAMINED_MAX; j++)
        if (has_area(&around[j]) &&
            (same_position(around[i].next, around[j].previous) || same_position(around[i].previous, around[j].next)))
            return around[j].fan;
    return around[otherwise].fan;
}

// Replaces the root of each corner with the number of its fan; fans are numbered in the order of their first corners.
// Returns the number of fans.
static uint32_t number_fans(struct fan_corner *around, uint32_t count, uint32_t *number)
{
    uint32_t fans = 0;
    memset(number, 0xff, count * sizeof *number);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *n = &number[around[i].fan];
        if (*n == UINT32_MAX)
            *n = fans++;
        around[i].fan = *n;
    }
    return fans;
}

uint32_t corner_fan_normals(const lam_mesh *mesh, double min_cosine, struct corner_fan_scratch *scratch, uint32_t count)
{
    struct fan_corner *around = scratch->corners;
    uint32_t flat = 0, first_with_area = 0;
    for (uint32_t i = count; i-- > 0;) {
        look(mesh, scratch->numbers[i], &around[i]);
        around[i].fan = i;
        if (has_area(&around[i]))
            first_with_area = i;
        else
            flat++;
    }
    if (count <= 24)
        join_few(around, count, min_cosine);
    else
        join_many(around, scratch->edges, count, min_cosine);
    for (uint32_t i = 0; i < count; i++)
        around[i].fan = root_of(around, i);
    for (uint32_t i = 0; flat && i < count; i++)
        if (!has_area(&around[i]))
            around[i].fan = neighbouring_fan(around, count, i, first_with_area);

    // The memory of scratch->numbers and scratch->edges is reused: `around` contains the numbers too, and the edges are
    // no longer needed.
    uint32_t fans = number_fans(around, count, scratch->numbers);
    double(*sums)[3] = (double(*)[3])scratch->edges;
    memset(sums, 0, fans * sizeof *sums);
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++)
            sums[around[i].fan][a] += around[i].normal[a] * around[i].weight;
    for (uint32_t f = 0; f < fans; f++) {
        lam_vec3 unit = v3_unit(v3(sums[f][0], sums[f][1], sums[f][2]));
        scratch->normals[f][0] = (float)unit.x;
        scratch->normals[f][1] = (float)unit.y;
        scratch->normals[f][2] = (float)unit.z;
    }
    return fans;
}

// --- moves positions with the same number of corners to a struct corner_fan_block, so that corner_fan_simd.c can
// process them in parallel lanes.

CPU_VERSIONS(const struct corner_fan_simd, corner_fan_simd);

const struct corner_fan_simd *corner_fan_simd_for(int lanes) { return CPU_WIDEST(lanes, corner_fan_simd); }

bool corner_fan_batch_take(struct corner_fan_batch *batch, uint32_t count)
{
    struct corner_fan_block *block = &batch->block;
    block->count = count;
    block->positions = batch->waiting[count];
    batch->waiting[count] = 0;
    memcpy(block->corners, batch->rows + count * (count - 1) / 2, count * sizeof *batch->rows);
    for (uint32_t i = 0; block->positions && i < count; i++)
        for (uint32_t p = block->positions; p < FAN_POSITIONS; p++)
            block->corners[i][p] = block->corners[i][p - 1];
    return block->positions > 0;
}
