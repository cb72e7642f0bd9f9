// edge_specks.c: removes feature edges that form only specks in the picture. Scans, and meshes of CAD programs with
// slivers, contain many short creases, which look like dirt instead of lines.
//
// Edges with common ends form a group. The group's size is the sum of the integer weights of its edges, so the size
// does not depend on the order of the edges.
#include "edge_tasks.h"

#include "linear.h"

#include <stdlib.h>
#include <string.h>

enum { CHECK_INTERVAL = 1 << 14, SPECK_MAX = 8 * EDGE_WEIGHT_PIXEL };

// An entry of the hash table: a vertex at which edges end, and the group that the vertex belongs to.
struct vertex {
    double p[3];
    uint32_t parent; // another vertex of the same group, or the vertex itself
    uint32_t size;   // at a vertex that is its own parent, the size of the group
};

struct groups {
    struct vertex *vertices;
    uint8_t *used; // whether a slot contains a vertex
    uint32_t mask; // slots − 1
};

static uint32_t hash_of(const double p[3])
{
    uint64_t hash = 0;
    for (int i = 0; i < 3; i++) {
        uint64_t bits;
        memcpy(&bits, &p[i], sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return (uint32_t)(hash >> 32);
}

// Returns the slot of a vertex. Adds the vertex if it is new.
static uint32_t vertex_at(struct groups *groups, const double at[3])
{
    const double p[3] = {at[0] + 0.0, at[1] + 0.0, at[2] + 0.0}; // −0 becomes 0
    uint32_t slot = hash_of(p) & groups->mask;
    for (; groups->used[slot]; slot = (slot + 1) & groups->mask)
        if (memcmp(groups->vertices[slot].p, p, sizeof p) == 0)
            return slot;
    groups->used[slot] = 1;
    groups->vertices[slot] = (struct vertex){.p = {p[0], p[1], p[2]}, .parent = slot};
    return slot;
}

static uint32_t group_of(struct groups *groups, uint32_t slot)
{
    struct vertex *v = groups->vertices;
    while (v[slot].parent != slot) {
        v[slot].parent = v[v[slot].parent].parent;
        slot = v[slot].parent;
    }
    return slot;
}

static bool groups_start(struct groups *groups, size_t edges, struct call_control *call)
{
    size_t slots = 16;
    while (slots < 4 * edges)
        slots *= 2;
    *groups = (struct groups){.mask = (uint32_t)(slots - 1)};
    if (slots > UINT32_MAX || !call_charge(call, slots * (sizeof *groups->vertices + 1)))
        return false;
    groups->vertices = malloc(slots * sizeof *groups->vertices);
    groups->used = calloc(slots, 1);
    return groups->vertices && groups->used;
}

static void groups_free(struct groups *groups, struct call_control *call)
{
    if (groups->mask && (groups->vertices || groups->used))
        call_refund(call, ((size_t)groups->mask + 1) * (sizeof *groups->vertices + 1));
    free(groups->vertices);
    free(groups->used);
}

static void join(struct groups *groups, const double ends[2][3], uint32_t weight)
{
    uint32_t a = group_of(groups, vertex_at(groups, ends[0])), b = group_of(groups, vertex_at(groups, ends[1]));
    struct vertex *v = groups->vertices;
    uint64_t size = (uint64_t)v[a].size + weight + (a != b ? v[b].size : 0);
    v[b].parent = a;
    v[a].size = size < SPECK_MAX ? (uint32_t)size : SPECK_MAX;
}

bool edge_specks_drop(const struct edge_task *draws, int draw_count, struct loop_status *loop)
{
    struct groups groups;
    size_t weighed = 0;
    for (int i = 0; i < draw_count; i++)
        for (uint32_t e = 0; e < draws[i].count; e++)
            weighed += draws[i].weights[e] != EDGE_UNWEIGHED;
    bool ok = groups_start(&groups, weighed, loop->call);
    for (int round = 0; round < 2; round++)
        for (int i = 0; i < draw_count && ok; i++)
            for (uint32_t e = 0; e < draws[i].count && ok; e++) {
                uint16_t *weight = &draws[i].weights[e];
                double ends[2][3];
                ok = e % CHECK_INTERVAL || should_continue(loop);
                if (*weight == EDGE_UNWEIGHED)
                    continue;
                edge_task_ends(&draws[i], e, ends);
                if (round == 0)
                    join(&groups, ends, *weight);
                else if (groups.vertices[group_of(&groups, vertex_at(&groups, ends[0]))].size < SPECK_MAX)
                    *weight = EDGE_SPECK;
            }
    groups_free(&groups, loop->call);
    return ok;
}
