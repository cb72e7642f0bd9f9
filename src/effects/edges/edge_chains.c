// edge_chains.c: links edges into chains, so that dashes run along a curve of many short edges instead of restarting at
// each edge.
//
// A single thread links the edges, in the order of the list, so the dashes do not depend on the number of threads.
#include "edge_tasks.h"

#include "linear.h"

#include <stdlib.h>

enum { CHECK_INTERVAL = 1 << 14, TOGETHER_MAX = 16 }; // a corner with more ends has no links

// An end of a line at a corner of the mesh.
struct end {
    float p[3];
    uint32_t end; // twice the index of the edge, plus 0 or 1
};

static int compare_places(const struct end *x, const struct end *y)
{
    for (int i = 0; i < 3; i++)
        if (x->p[i] != y->p[i])
            return x->p[i] < y->p[i] ? -1 : 1;
    return 0;
}

static int by_place(const void *a, const void *b)
{
    const struct end *x = a, *y = b;
    int places = compare_places(x, y);
    return places ? places : (x->end > y->end) - (x->end < y->end);
}

static struct end end_of(const lam_mesh *mesh, const struct mesh_edge *edge, uint32_t end)
{
    uint32_t corner = end & 1 ? edge_end(edge->corner) : edge->corner;
    const float *p = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[corner] : corner);
    return (struct end){{p[0], p[1], p[2]}, end};
}

// Returns the cosine of the angle between a line that arrives at one end and a line that leaves from the other end.
static double straightness(const struct edge_measure *measures, uint32_t a, uint32_t b)
{
    const struct edge_measure *m = &measures[a >> 1], *n = &measures[b >> 1];
    double ax = m->x[a & 1] - m->x[~a & 1], ay = m->y[a & 1] - m->y[~a & 1];
    double bx = n->x[~b & 1] - n->x[b & 1], by = n->y[~b & 1] - n->y[b & 1];
    double size = m->length * n->length;
    // A line seen end-on has no direction in the picture, so it may continue any other line.
    return size > 1e-6 ? (ax * bx + ay * by) / size : 1;
}

// Pairs the ends at one corner, the straightest pair first. If a vertex has exactly two lines, they are always paired,
// because silhouettes of a fine mesh zigzag.
static void link_corner(struct edge_measure *measures, const struct end *ends, uint32_t count)
{
    if (count > TOGETHER_MAX)
        return;
    for (uint32_t pairs = 0; pairs < count / 2; pairs++) {
        double best = count == 2 ? -2 : 0.5; // cos 60°
        uint32_t from = 0, to = 0;
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t k = i + 1; k < count; k++) {
                uint32_t a = ends[i].end, b = ends[k].end;
                if (measures[a >> 1].link[a & 1] != NO_LINK || measures[b >> 1].link[b & 1] != NO_LINK ||
                    measures[a >> 1].style != measures[b >> 1].style || a >> 1 == b >> 1)
                    continue;
                double straight = straightness(measures, a, b);
                if (straight > best) {
                    best = straight;
                    from = a;
                    to = b;
                }
            }
        if (from == to)
            return;
        measures[from >> 1].link[from & 1] = to;
        measures[to >> 1].link[to & 1] = from;
    }
}

// Computes the positions of all edges in the chain of an edge, from the beginning of the chain. A closed chain begins
// at the edge that follows this edge.
static void place_chain(struct edge_measure *measures, uint32_t edge)
{
    uint32_t first = 2 * edge; // the end at which the chain is entered
    for (uint32_t before; (before = measures[first >> 1].link[first & 1]) != NO_LINK && before >> 1 != edge;)
        first = before ^ 1;
    double length = 0;
    for (uint32_t at = first; at != NO_LINK && !measures[at >> 1].placed; at = measures[at >> 1].link[~at & 1]) {
        struct edge_measure *m = &measures[at >> 1];
        m->placed = true;
        m->start = length;
        m->reversed = at & 1;
        length += m->length;
    }
}

bool edge_chains_link(const struct frame_draw *draw, const struct mesh_edge *edges, struct edge_measure *measures,
                      uint32_t count, struct loop_status *loop)
{
    size_t capacity = 0, used = 0;
    for (uint32_t e = 0; e < count; e++)
        capacity += measures[e].style < 0 ? 0 : 2;
    if (!call_charge(loop->call, capacity * sizeof(struct end)))
        return false;
    struct end *ends = malloc((capacity + 1) * sizeof *ends);
    for (uint32_t e = 0; e < count && ends; e++)
        for (uint32_t k = 0; k < 2 && measures[e].style >= 0; k++)
            if (measures[e].whole[k])
                ends[used++] = end_of(draw->mesh, &edges[e], 2 * e + k);
    bool ok = ends && should_continue(loop);
    if (ok)
        qsort(ends, used, sizeof *ends, by_place);
    for (size_t from = 0, to; ok && from < used; from = to) {
        for (to = from + 1; to < used && compare_places(&ends[to], &ends[from]) == 0; to++)
            ;
        link_corner(measures, ends + from, (uint32_t)(to - from));
    }
    free(ends);
    call_refund(loop->call, capacity * sizeof(struct end));
    for (uint32_t e = 0; e < count && ok; e++) {
        if (measures[e].style >= 0 && !measures[e].placed)
            place_chain(measures, e);
        ok = e % CHECK_INTERVAL || should_continue(loop);
    }
    return ok;
}
