// builder.h: the state while a hierarchy is built.
#ifndef BUILDER_H
#define BUILDER_H

#include "hierarchy.h"
#include "loop_status.h"

// The number of triangles per task in ray_triangles.c; cells.c uses at least eight times this number.
enum { RAY_CHUNK = 4096 };

// The box of a triangle. low[3] contains the bits of the triangle's number, and high[3] the bits of 1. For a cell's
// triangles (cells.c), low[3] is the first triangle and high[3] the count.
struct primitive {
    _Alignas(16) float low[4];
    float high[4];
};

static inline uint32_t primitive_number(const struct primitive *p)
{
    uint32_t number;
    __builtin_memcpy(&number, &p->low[3], sizeof number);
    return number;
}

static inline uint32_t primitive_weight(const struct primitive *p)
{
    uint32_t weight;
    __builtin_memcpy(&weight, &p->high[3], sizeof weight);
    return weight;
}

static inline void primitive_note(struct primitive *p, uint32_t number, uint32_t weight)
{
    __builtin_memcpy(&p->low[3], &number, sizeof number);
    __builtin_memcpy(&p->high[3], &weight, sizeof weight);
}

struct builder {
    const struct frame *frame;
    struct hierarchy *hierarchy;
    struct ray_triangle *triangles; // the triangles in the order of the leaves
    struct ray_node *nodes;
    uint32_t *twins;
    struct primitive *primitives; // the primitives of the ranges that are being divided
    struct primitive *in_cells;   // the primitives of a large range, sorted by cell
    struct pool *pool;
    struct loop_status loop;
};

// Sets the primitives, and the hierarchy's centre and scale.
bool ray_triangles_prepare(struct builder *builder, lam_error *error);

// Returns the largest number of nodes for a range of this many triangles. A node with fewer than NODE_CHILDREN children
// has only leaves, and more than LEAF_MIN triangles. By induction, the number of nodes is at most (2 count − 1)/7.
static inline uint32_t ray_nodes_below(uint32_t count) { return count ? (uint32_t)((2 * (uint64_t)count - 1) / 7) : 0; }

// Divides the primitives into nodes and leaves.
bool ray_nodes_build(struct builder *builder, lam_error *error);

#endif
