// builder.h: a hierarchy while it is built.
#ifndef BUILDER_H
#define BUILDER_H

#include "hierarchy.h"
#include "loop_status.h"

// Triangles are prepared, and the largest ranges divided, in pieces of this many.
enum { RAY_PIECE = 4096 };

// The box of a triangle. low[3] holds the bits of its number.
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

struct builder {
    const struct frame *frame;
    struct hierarchy *hierarchy;
    struct ray_triangle *prepared;  // by number
    struct ray_triangle *triangles; // in the order of the leaves
    struct ray_node *nodes;
    uint32_t *twins;
    struct primitive *primitives[2]; // large ranges move from one to the other as they are divided
    struct pool *pool;
    struct loop_status loop;
};

// Fills prepared, primitives[0], and the hierarchy's centre and scale.
bool ray_triangles_prepare(struct builder *builder, lam_error *error);

// The nodes over so many triangles, at most.
uint32_t ray_nodes_max(uint32_t triangle_count);

// Divides the primitives into nodes and leaves.
bool ray_nodes_build(struct builder *builder, lam_error *error);

#endif
