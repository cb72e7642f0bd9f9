// corner_fan.c: the normals at one position, from the corners that meet there.
#include "corner_fan.h"

#include "linear.h"
#include "weld.h"

#include <stdlib.h>
#include <string.h>

// An edge from the position, as one spoke has it.
struct fan_edge {
    uint32_t end[3]; // bits of the other end
    uint32_t spoke;
    uint32_t incoming; // 0: the triangle runs from the position to the end; 1: from the end to the position
};
_Static_assert(2 * sizeof(struct fan_edge) >= 3 * sizeof(double),
               "a fan's sum must fit into the room of a spoke's edges");

// Positions are floats: one and the same angle, computed from two of its sides, differs in the seventh digit.
#define CREASE_SLACK 1e-6

double fan_least_cosine(double crease_angle_rad) { return math_cos(crease_angle_rad) - CREASE_SLACK; }

static int compare_corners(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

void fan_sort(uint32_t *corners, uint32_t count)
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

void fan_room_start(struct fan_room *room, struct call_control *call)
{
    *room = (struct fan_room){0};
    arena_start(&room->arena, call);
}

void fan_room_free(struct fan_room *room) { arena_free(&room->arena); }

bool fan_room_reserve(struct fan_room *room, uint32_t count)
{
    if (count <= room->room)
        return true;
    uint32_t larger = room->room ? room->room : 64;
    while (larger < count)
        larger = larger > UINT32_MAX / 2 ? count : larger * 2;
    uint32_t *corners = arena_array(&room->arena, larger, sizeof *corners);
    room->spokes = arena_array(&room->arena, larger, sizeof *room->spokes);
    room->edges = arena_array(&room->arena, 2 * (size_t)larger, sizeof *room->edges);
    room->normals = arena_array(&room->arena, larger, sizeof *room->normals);
    if (!corners || !room->spokes || !room->edges || !room->normals) {
        room->room = 0;
        return false;
    }
    if (room->room)
        memcpy(corners, room->corners, room->room * sizeof *corners);
    room->corners = corners;
    room->room = larger;
    return true;
}

// atan2(y, x) for y ≥ 0 within 3e-6 rad: enough for a weight. The polynomial for atan on 0…1 goes through its
// values at the six Chebyshev nodes of x².
static double angle_of(double y, double x)
{
    double ax = x < 0 ? -x : x;
    bool steep = y > ax;
    double larger = steep ? y : ax;
    if (!(larger > 0))
        return 0;
    double t = (steep ? ax : y) / larger, z = t * t;
    double a = t * (0.9999948346338877 +
                    z * (-0.33295711032247277 +
                         z * (0.1953465900279569 +
                              z * (-0.12044858521312099 + z * (0.05658998519974516 + z * -0.013130382075233026)))));
    if (steep)
        a = PI / 2 - a;
    return x < 0 ? PI - a : a;
}

static void look(const lam_mesh *mesh, uint32_t corner, struct spoke *spoke)
{
    uint32_t triangle = corner / 3, k = corner - 3 * triangle;
    uint32_t next = k == 2 ? corner - 2 : corner + 1, before = k == 0 ? corner + 2 : corner - 1;
    const float *p = mesh->positions + 3 * (size_t)corner_vertex(mesh, corner);
    const float *q = mesh->positions + 3 * (size_t)corner_vertex(mesh, next);
    const float *r = mesh->positions + 3 * (size_t)corner_vertex(mesh, before);
    spoke->corner = corner;
    spoke->smoothing_group = mesh->smoothing_groups ? mesh->smoothing_groups[triangle] : 1;
    position_bits(q, spoke->next);
    position_bits(r, spoke->before);
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)q[i] - (double)p[i];
        b[i] = (double)r[i] - (double)p[i];
    }
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    // Twice the area. Differences of floats reach 7e38, so the square stays below 1e156, and above 1e-180 if
    // not 0.
    double length = __builtin_sqrt(x * x + y * y + z * z);
    bool spans = length > 0 && length < 1e300; // neither infinite nor NaN
    double scale = spans ? 1 / length : 0;
    spoke->normal[0] = spans ? x * scale : 0;
    spoke->normal[1] = spans ? y * scale : 0;
    spoke->normal[2] = spans ? z * scale : 0;
    // |a × b| and a·b are sine and cosine of the angle times the same lengths. The weight is below 1e78, and above 1e-90
    // if not 0: neither a sum of weighted normals nor its square leaves the range of doubles, whatever the unit.
    spoke->weight = spans ? length * angle_of(length, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) : 0;
}

static bool has_area(const struct spoke *s) { return s->normal[0] != 0 || s->normal[1] != 0 || s->normal[2] != 0; }

static uint32_t root_of(struct spoke *spokes, uint32_t i)
{
    while (spokes[i].fan != i) {
        spokes[i].fan = spokes[spokes[i].fan].fan; // halves the way for the next time
        i = spokes[i].fan;
    }
    return i;
}

// Joins two spokes that share an edge, if they may share a normal. The lower number stands for both.
static void join(struct spoke *spokes, uint32_t a, uint32_t b, double least_cosine)
{
    const struct spoke *s = &spokes[a], *t = &spokes[b];
    double cosine = s->normal[0] * t->normal[0] + s->normal[1] * t->normal[1] + s->normal[2] * t->normal[2];
    if (!(cosine >= least_cosine) || s->smoothing_group != t->smoothing_group || s->smoothing_group == 0 ||
        !has_area(s) || !has_area(t))
        return;
    uint32_t x = root_of(spokes, a), y = root_of(spokes, b);
    if (x < y)
        spokes[y].fan = x;
    else
        spokes[x].fan = y;
}

static bool same_bits(const uint32_t a[3], const uint32_t b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

// Consistently wound neighbours have their common edge in opposite directions: one's next corner is where the
// other's corner before is. Few spokes: every pair.
static void join_few(struct spoke *spokes, uint32_t count, double least_cosine)
{
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = 0; j < count; j++)
            if (same_bits(spokes[i].next, spokes[j].before) && i != j)
                join(spokes, i, j, least_cosine);
}

static int compare_edges(const void *left, const void *right)
{
    const struct fan_edge *a = left, *b = right;
    for (int i = 0; i < 3; i++)
        if (a->end[i] != b->end[i])
            return a->end[i] < b->end[i] ? -1 : 1;
    if (a->incoming != b->incoming)
        return a->incoming < b->incoming ? -1 : 1;
    return a->spoke < b->spoke ? -1 : a->spoke > b->spoke;
}

// Many spokes: by sorting. On an edge with so many triangles that all pairs would be too many, each outgoing
// one meets the incoming one of the same rank only; no real surface has such an edge.
static void join_many(struct spoke *spokes, struct fan_edge *edges, uint32_t count, double least_cosine)
{
    enum { PAIRS_MAX = 256 };
    for (uint32_t i = 0; i < count; i++) {
        memcpy(edges[2 * (size_t)i].end, spokes[i].next, 12);
        memcpy(edges[2 * (size_t)i + 1].end, spokes[i].before, 12);
        for (uint32_t k = 0; k < 2; k++) {
            edges[2 * (size_t)i + k].spoke = i;
            edges[2 * (size_t)i + k].incoming = k;
        }
    }
    size_t total = 2 * (size_t)count;
    qsort(edges, total, sizeof *edges,
          compare_edges); // no two are equal, so the order is one and the same everywhere
    for (size_t first = 0; first < total;) {
        size_t split = first, end;
        while (split < total && !edges[split].incoming && same_bits(edges[split].end, edges[first].end))
            split++;
        for (end = split; end < total && edges[end].incoming && same_bits(edges[end].end, edges[first].end);)
            end++;
        size_t out = split - first, in = end - split;
        bool all = out <= PAIRS_MAX && in <= PAIRS_MAX && out * in <= PAIRS_MAX;
        for (size_t i = 0; i < out; i++)
            for (size_t j = all ? 0 : i; j < (all || i >= in ? in : i + 1); j++)
                if (edges[first + i].spoke != edges[split + j].spoke)
                    join(spokes, edges[first + i].spoke, edges[split + j].spoke, least_cosine);
        first = end;
    }
}

// The fan for a corner of a triangle without area: that of the first neighbour across an edge that has one,
// else the fan of `otherwise`.
static uint32_t fan_beside(const struct spoke *spokes, uint32_t count, uint32_t i, uint32_t otherwise)
{
    enum { LOOKED_AT_MAX = 64 }; // so that a position with a million such corners takes no million squared steps
    for (uint32_t j = 0; j < count && j < LOOKED_AT_MAX; j++)
        if (has_area(&spokes[j]) &&
            (same_bits(spokes[i].next, spokes[j].before) || same_bits(spokes[i].before, spokes[j].next)))
            return spokes[j].fan;
    return spokes[otherwise].fan;
}

// Turns roots into numbers of fans, in the order of their first corners. Returns how many there are.
static uint32_t number_fans(struct spoke *spokes, uint32_t count, uint32_t *number)
{
    uint32_t fans = 0;
    memset(number, 0xff, count * sizeof *number);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *n = &number[spokes[i].fan];
        if (*n == UINT32_MAX)
            *n = fans++;
        spokes[i].fan = *n;
    }
    return fans;
}

uint32_t fan_normals(const lam_mesh *mesh, double least_cosine, struct fan_room *room, uint32_t count)
{
    struct spoke *spokes = room->spokes;
    uint32_t flat = 0, first_with_area = 0;
    for (uint32_t i = count; i-- > 0;) {
        look(mesh, room->corners[i], &spokes[i]);
        spokes[i].fan = i;
        if (has_area(&spokes[i]))
            first_with_area = i;
        else
            flat++;
    }
    if (count <= 24)
        join_few(spokes, count, least_cosine);
    else
        join_many(spokes, room->edges, count, least_cosine);
    for (uint32_t i = 0; i < count; i++)
        spokes[i].fan = root_of(spokes, i);
    for (uint32_t i = 0; flat && i < count; i++)
        if (!has_area(&spokes[i]))
            spokes[i].fan = fan_beside(spokes, count, i, first_with_area);

    // The corners are in the spokes too, the edges are done with: their room serves for the numbers and the sums.
    uint32_t fans = number_fans(spokes, count, room->corners);
    double(*sums)[3] = (double(*)[3])room->edges;
    memset(sums, 0, fans * sizeof *sums);
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++)
            sums[spokes[i].fan][a] += spokes[i].normal[a] * spokes[i].weight;
    for (uint32_t f = 0; f < fans; f++) {
        lam_vec3 unit = v3_unit(v3(sums[f][0], sums[f][1], sums[f][2]));
        room->normals[f][0] = (float)unit.x;
        room->normals[f][1] = (float)unit.y;
        room->normals[f][2] = (float)unit.z;
    }
    return fans;
}
