// corner_fan_simd.h: computes fans (corner_fan.h) at many positions in parallel lanes. The code is compiled once for
// each instruction set (meson.build). Every version is bit-identical to corner_fan.c.
#ifndef CORNER_FAN_SIMD_H
#define CORNER_FAN_SIMD_H

#include "rank_bitset.h"

#include <lambent/mesh.h>

enum {
    FAN_POSITIONS = 32,   // positions per block; gcc unrolls loops of 16 instead of vectorizing them
    FAN_CORNERS_MAX = 16, // the maximum number of corners at a position
};

// One number for each position.
typedef uint32_t fan_row[FAN_POSITIONS];

// Positions with the same number of corners, one in each column: row i contains corner i of each position.
struct corner_fan_block {
    uint32_t count, positions;        // corners per position; the columns after the last position repeat that position
    bool by_vertex;                   // the corners in a column belong to one vertex
    fan_row corners[FAN_CORNERS_MAX]; // `make` sorts the corners of each position in ascending order
    fan_row open;                     // with by_vertex, nonzero if the vertex is not closed (normals.h)
    fan_row flat;                     // nonzero if a triangle is degenerate; the other fields are then invalid
    // The fans at each position, in the order of their first corners. For each fan, `members` contains its corners as
    // bits (0 if the position has fewer fans), and `unit` its normal.
    uint32_t fans; // the largest number of fans at a position
    fan_row members[FAN_CORNERS_MAX];
    float unit[FAN_CORNERS_MAX][3][FAN_POSITIONS];
    uint64_t elements[FAN_CORNERS_MAX][FAN_POSITIONS]; // indices of the corners in visible_normals.elements

    // Intermediate values.
    fan_row triangles[FAN_CORNERS_MAX], groups[FAN_CORNERS_MAX];
    fan_row next_vertex[FAN_CORNERS_MAX], previous_vertex[FAN_CORNERS_MAX]; // the triangle's vertices
    float here[3][FAN_POSITIONS], next[FAN_CORNERS_MAX][3][FAN_POSITIONS], previous[FAN_CORNERS_MAX][3][FAN_POSITIONS];
    double normal[FAN_CORNERS_MAX][3][FAN_POSITIONS];   // the triangle's unit normal, zero if it has no area
    double weighted[FAN_CORNERS_MAX][3][FAN_POSITIONS]; // the normal × twice the area × the angle at the corner
    fan_row links[FAN_CORNERS_MAX];                     // bit j: the corner is joined to corner j
};

struct corner_fan_simd {
    int lanes; // floats in a register
    // Computes the fans from count, positions and corners.
    void (*make)(struct corner_fan_block *block, const lam_mesh *mesh, double min_cosine);
    // Fills `elements`; must be called after `make`. Removes the members whose triangles are not in the set
    // `triangles`. In this set, the mesh's triangle 0 has the number `first`. Also removes corners of open vertices,
    // and of vertices whose bits are set in `done` (may be NULL). Returns the number of fans that have members.
    uint32_t (*locate)(struct corner_fan_block *block, const lam_mesh *mesh, const struct rank_bitset *triangles,
                       uint32_t first, const uint64_t *done);
};

// Returns the widest version that the processor supports, with at most `lanes` lanes.
const struct corner_fan_simd *corner_fan_simd_for(int lanes);

#endif
