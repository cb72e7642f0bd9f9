// hierarchy.h: a bounding volume hierarchy over all triangles of a frame, for rays.
//
// One test in double precision decides whether a ray meets a triangle (ray_lanes.h). The boxes of the hierarchy only
// exclude triangles that the ray cannot meet, so they do not affect results. The hierarchy is built by a fixed set of
// tasks, so it is identical for any number of threads. The OpenGL device reads the same hierarchy.
#ifndef HIERARCHY_H
#define HIERARCHY_H

#include "buffer.h"
#include "frame.h"
#include "pool.h"

// A triangle in the hierarchy's space.
struct ray_triangle {
    double p[3][3];  // corners
    uint32_t number; // in the frame
    uint32_t
        twin; // the lowest number of all triangles with the same three positions; usually the triangle's own number
};

// A node: the boxes of its children as conservative floats. A node has the size of four cache lines.
enum { NODE_CHILDREN = 8 };
struct ray_node {
    _Alignas(64) float planes[2][3][NODE_CHILDREN]; // low and high planes, by axis; without a child, 3e38 and −3e38
    uint32_t child[NODE_CHILDREN];                  // a node's index if count is 0, otherwise the first triangle
    uint32_t count[NODE_CHILDREN];                  // triangles of a leaf
};

enum {
    HIERARCHY_DEPTH = 120, // the maximum number of nodes from the root to a leaf
    NO_TRIANGLE = -1,      // a ray that does not start on a triangle
};

struct hierarchy {
    // From world space: p → (p − centre) scale, so that all corners are within −1…1. The scale is a power of two.
    double centre[3], scale;
    const struct ray_node *nodes;         // the root first
    const struct ray_triangle *triangles; // the triangles in the order of the leaves; the array has space for one more
    uint32_t node_count;                  // number of entries of `nodes`, some of which are unused; may be 0
    uint32_t triangle_count;
    const uint32_t *twins; // for each triangle of the frame, see ray_triangle.twin
    // For each axis, the largest rounding error of a corner (compared with the file) or of a point in a triangle.
    double rounding[3];
};

// The hierarchy that a device keeps from frame to frame, and its input.
struct hierarchy_memory {
    struct hierarchy hierarchy;
    struct buffer nodes, triangles, twins, scratch, sources;
    int source_count;
    struct scene_token *token; // referenced; NULL if nothing is built
};

// Gets a triangle's corners in world space from the mesh's floats.
static inline void ray_corners(const struct frame_draw *draw, uint32_t triangle, double p[3][3])
{
    const lam_mesh *mesh = draw->mesh;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t element = mesh->indices ? mesh->indices[3 * (size_t)triangle + k] : 3 * triangle + k;
        frame_to_world(draw, mesh->positions + 3 * (size_t)element, p[k]);
    }
}

// Transforms a point from world space to the hierarchy's space.
static inline void ray_point(const struct hierarchy *h, const double world[3], double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = (world[i] - h->centre[i]) * h->scale;
}

#endif
