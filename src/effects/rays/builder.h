// builder.h: the state while a hierarchy is built.
#ifndef BUILDER_H
#define BUILDER_H

#include "hierarchy.h"
#include "loop_status.h"

// The number of triangles per task in ray_triangles.c.
enum { RAY_CHUNK = 4096 };

// The box of a triangle. low[3] contains the bits of the triangle's index in a list, and high[3] the bits of 1. For a
// cell's triangles (cells.c), low[3] is the cell and high[3] the count.
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
    float *leaves;
    uint32_t *twins;
    bool has_twins;        // whether a triangle is not its own twin; atomic
    uint32_t *numbers;     // the triangles in the order of the ranges
    bool sorted;           // whether `numbers` is filled
    float low[4], high[4]; // of all corners in the hierarchy's space
    struct buffer *nodes;
    struct pool *pool;
    struct loop_status loop;
};

// Sets the hierarchy's centre and scale, and the bounds of all corners.
bool ray_space_choose(struct builder *builder, lam_error *error);

// Divides the triangles into nodes and leaves.
bool ray_nodes_build(struct builder *builder, lam_error *error);

#endif
