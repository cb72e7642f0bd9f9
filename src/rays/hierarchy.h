// hierarchy.h: a bounding volume hierarchy over all triangles of a frame, for rays.
//
// Whether a ray meets a triangle is decided by one test in double (ray_lanes.h), so the answer to "does anything lie in
// the way?" does not depend on the hierarchy: its boxes are only conservative. It is built from fixed tasks and is
// identical for any number of threads; OpenGL also reads it.
#ifndef HIERARCHY_H
#define HIERARCHY_H

#include "buffer.h"
#include "frame.h"
#include "pool.h"

// A triangle in the hierarchy's space.
struct ray_triangle {
    double p[3][3];  // corners
    uint32_t number; // in the frame
    uint32_t twin;   // the lowest number of a triangle with the same three positions; often its own
};

// A node: the boxes of its children, conservative floats. Four cache lines.
enum { NODE_CHILDREN = 8 };
struct ray_node {
    _Alignas(64) float planes[2][3][NODE_CHILDREN]; // low and high, by axis; without a child, 3e38 and −3e38
    uint32_t child[NODE_CHILDREN];                  // count 0: the number of a node; else the first triangle
    uint32_t count[NODE_CHILDREN];                  // triangles of a leaf
};

enum {
    HIERARCHY_DEPTH = 120, // nodes from the root to a leaf, at most
    NO_TRIANGLE = -1,      // as the triangle that a ray starts on: none
};

struct hierarchy {
    // From world space: p → (p − centre) scale, so that all corners lie within −1…1. The scale is a power of two.
    double centre[3], scale;
    const struct ray_node *nodes;         // the root first
    const struct ray_triangle *triangles; // in the order of the leaves; one more may follow them
    uint32_t node_count;                  // entries of `nodes`, some unused, and 0
    uint32_t triangle_count;
    const uint32_t *twins; // of each triangle of the frame, as ray_triangle.twin
    // How far, along each axis, rounding may have moved a corner from where its file means it, and a point of its triangle.
    double rounding[3];
};

// The hierarchy that a device keeps from frame to frame, and its input.
struct hierarchy_memory {
    struct hierarchy hierarchy;
    struct buffer nodes, triangles, twins, scratch, sources;
    int source_count;
    struct scene_token *token; // held; NULL: nothing is built
};

// Builds the hierarchy of a frame, unless the one in memory is of the same meshes at the same places; *built: whether
// it did. Fails with LAM_LIMIT (memory, time), LAM_CANCELLED.
const struct hierarchy *hierarchy_of_frame(struct hierarchy_memory *memory, const struct frame *frame,
                                           struct pool *pool, struct call_control *call, bool *built, lam_error *error);
void hierarchy_free(struct hierarchy_memory *memory);
uint64_t hierarchy_bytes(const struct hierarchy_memory *memory);

// A triangle's corners in world space, from the mesh's floats.
static inline void ray_corners(const struct frame_draw *draw, uint32_t triangle, double p[3][3])
{
    const lam_mesh *mesh = draw->mesh;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t element = mesh->indices ? mesh->indices[3 * (size_t)triangle + k] : 3 * triangle + k;
        frame_to_world(draw, mesh->positions + 3 * (size_t)element, p[k]);
    }
}

// From world space to the hierarchy's.
static inline void ray_point(const struct hierarchy *h, const double world[3], double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = (world[i] - h->centre[i]) * h->scale;
}

#endif
