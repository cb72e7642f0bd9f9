// corner_fan_simd.h: fans (corner_fan.h) at many positions side by side, compiled once for each instruction set
// (meson.build). Every one gives the bits of corner_fan.c.
#ifndef CORNER_FAN_SIMD_H
#define CORNER_FAN_SIMD_H

#include "rank_bitset.h"

#include <lambent/mesh.h>

enum {
    FAN_POSITIONS = 32,   // side by side; gcc unrolls loops of 16 instead of vectorizing them
    FAN_CORNERS_MAX = 16, // corners at one of them
};

// One number for each position.
typedef uint32_t fan_row[FAN_POSITIONS];

// Positions where equally many corners meet, one in each column: row i has their corners i.
struct corner_fan_block {
    uint32_t count, positions;        // corners at each; the columns after the last position repeat it
    bool by_vertex;                   // the corners in a column belong to one vertex
    fan_row corners[FAN_CORNERS_MAX]; // ascending at each position once `make` has run
    fan_row open;                     // by_vertex and nonzero: the vertex is not closed (normals.h)
    fan_row flat;                     // nonzero: a degenerate triangle; the other fields are invalid
    // Fans, numbered at each position by their first corners: their corners as bits (0: the position has fewer fans),
    // and their normals.
    uint32_t fans; // the largest number of them at a position
    fan_row members[FAN_CORNERS_MAX];
    float unit[FAN_CORNERS_MAX][3][FAN_POSITIONS];
    uint64_t elements[FAN_CORNERS_MAX][FAN_POSITIONS]; // indices of the corners in visible_normals.elements

    // Intermediate values.
    fan_row triangles[FAN_CORNERS_MAX], groups[FAN_CORNERS_MAX];
    fan_row next_vertex[FAN_CORNERS_MAX], previous_vertex[FAN_CORNERS_MAX]; // of the triangle
    float here[3][FAN_POSITIONS], next[FAN_CORNERS_MAX][3][FAN_POSITIONS], previous[FAN_CORNERS_MAX][3][FAN_POSITIONS];
    double normal[FAN_CORNERS_MAX][3][FAN_POSITIONS];   // of the triangle, unit; zero without area
    double weighted[FAN_CORNERS_MAX][3][FAN_POSITIONS]; // the normal × twice the area × the angle at the corner
    fan_row links[FAN_CORNERS_MAX];                     // bit j: the corner is joined to corner j
};

struct corner_fan_simd {
    int lanes; // floats in a register
    // Computes the fans from count, positions and corners.
    void (*make)(struct corner_fan_block *block, const lam_mesh *mesh, double min_cosine);
    // Then fills `elements`, and leaves as members only corners of triangles in the set, where the mesh's triangle 0 has
    // the number `first`, and none of open vertices
    // or of those whose bits are set in `done`, which may be NULL. Returns the number of fans that have members.
    uint32_t (*locate)(struct corner_fan_block *block, const lam_mesh *mesh, const struct rank_bitset *triangles,
                       uint32_t first, const uint64_t *done);
};

// Returns the widest that the processor has, of at most `lanes` lanes.
const struct corner_fan_simd *corner_fan_simd_for(int lanes);

#endif
