// hierarchy.h: a bounding volume hierarchy over all triangles of a frame, for rays.
//
// One test in double precision decides whether a ray meets a triangle (ray_lanes.h). The boxes of the hierarchy and the
// floats of its leaves only exclude triangles that the ray cannot meet, so they do not affect results. The hierarchy is
// built by a fixed set of tasks, so it is identical for any number of threads. The OpenGL device reads the same
// hierarchy.
#ifndef HIERARCHY_H
#define HIERARCHY_H

#include "buffer.h"
#include "frame.h"
#include "pool.h"

// A triangle in the hierarchy's space. The hierarchy does not store these triangles: hierarchy_triangle computes them
// from the meshes.
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
    uint32_t count[NODE_CHILDREN];                  // triangles of a leaf, at most LEAF_MAX
};

enum {
    HIERARCHY_DEPTH = 120, // the maximum number of nodes from the root to a leaf
    NO_TRIANGLE = -1,      // a ray that does not start on a triangle
    LEAF_MAX = 16,
    // A leaf of n triangles is nine rows of n floats, the coordinates of the three corners (x, y, z of the first, …),
    // and a row of n numbers. The triangle `first` of the hierarchy begins at the float LEAF_FLOATS · first.
    LEAF_FLOATS = 10,
};

// The triangles of one draw. Equal pointers mean equal contents, since a scene never modifies its arrays.
struct ray_source {
    const float *positions;
    const uint32_t *indices;
    uint32_t triangle_count, first_id;
    bool blocks;
    double square; // of a ground
    double world[3][4];
};

struct hierarchy {
    // From world space: p → (p − centre) scale, so that all corners are within −1…1. The scale is a power of two.
    double centre[3], scale;
    const struct ray_node *nodes; // the root first
    const float *leaves;          // rounded to the nearest floats
    uint32_t node_count;          // may be 0
    uint32_t triangle_count;      // triangles of the frame; the leaves contain those that block rays
    const uint32_t *twins;        // ray_triangle.twin for each triangle of the frame; NULL if each is its own twin
    const struct ray_source *sources;
    int source_count;
    // For each axis, the largest rounding error of a corner (compared with the file) or of a point in a triangle.
    double rounding[3];
};

// The hierarchy that a device keeps from frame to frame, and its input.
struct hierarchy_memory {
    struct hierarchy hierarchy;
    struct buffer nodes, leaves, twins, scratch, sources;
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

static inline uint32_t hierarchy_twin(const struct hierarchy *h, uint32_t number)
{
    return h->twins ? h->twins[number] : number;
}

// Computes the triangle with a number in the frame.
static inline void hierarchy_triangle(const struct hierarchy *h, uint32_t number, struct ray_triangle *triangle)
{
    int low = 0, high = h->source_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (h->sources[middle].first_id <= number)
            low = middle;
        else
            high = middle - 1;
    }
    const struct ray_source *source = &h->sources[low];
    for (uint32_t k = 0; k < 3; k++) {
        size_t corner = 3 * (size_t)(number - source->first_id) + k;
        const float *from = source->positions + 3 * (source->indices ? source->indices[corner] : corner);
        double x = (double)from[0], y = (double)from[1], z = (double)from[2], world[3];
        for (int i = 0; i < 3; i++) // as in frame_to_world
            world[i] =
                ((source->world[i][0] * x + source->world[i][1] * y) + source->world[i][2] * z) + source->world[i][3];
        ray_point(h, world, triangle->p[k]);
    }
    triangle->number = number;
    triangle->twin = hierarchy_twin(h, number);
}

// Returns the number in the frame of triangle i of a leaf with `count` triangles.
static inline uint32_t leaf_number(const float *leaf, uint32_t count, uint32_t i)
{
    uint32_t number;
    __builtin_memcpy(&number, leaf + (LEAF_FLOATS - 1) * count + i, sizeof number);
    return number;
}

#endif
