// corner_fan.h: computes the normals at one position from the adjacent corners.
#ifndef CORNER_FAN_H
#define CORNER_FAN_H

#include "arena.h"
#include "normals_memory.h"

#include <lambent/mesh.h>

// A corner at the position, and its triangle relative to that position.
struct fan_corner {
    uint32_t corner;
    uint32_t smoothing_group;
    // Bits of the positions of the triangle's next and previous corners; −0 is stored as 0.
    uint32_t next[3], previous[3];
    double normal[3]; // the triangle's unit normal, zero if it has no area
    double weight;    // twice the area × the angle at the corner in radians
    uint32_t fan;     // while corners are joined: a corner to which this corner is joined; afterwards: the number of
                      // its fan
};

// Scratch memory of one thread. The memory grows to fit the position with the most corners.
struct corner_fan_scratch {
    struct arena arena;
    uint32_t *numbers; // input: the corners at the position
    struct fan_corner *corners;
    struct fan_edge *edges;
    float (*normals)[3]; // output: the normals of the fans
    uint32_t capacity;
};
void corner_fan_scratch_start(struct corner_fan_scratch *scratch, struct call_control *call);
void corner_fan_scratch_free(struct corner_fan_scratch *scratch);
// Makes space for `count` corners. Returns false if memory runs out.
bool corner_fan_scratch_reserve(struct corner_fan_scratch *scratch, uint32_t count);

// Computes the fans of the `count` corners in scratch->numbers, by the rule in normals.h. The corners are in ascending
// order and all at one position. Returns the number of fans. scratch->normals[fan] is a fan's unit normal (zero if no
// triangle has an area); fans are numbered by their first corner, and scratch->corners[i].fan is the fan of corner i.
uint32_t corner_fan_normals(const lam_mesh *mesh, double min_cosine, struct corner_fan_scratch *scratch,
                            uint32_t count);

// Sorts corners. The function is fast if the corners are nearly in order.
void sort_corners(uint32_t *corners, uint32_t count);

// Converts the crease angle to the smallest cosine between the normals of two faces that corner_fan_normals joins.
double min_crease_cosine(double crease_angle_rad);

// Returns the vertex of a corner.
static inline uint32_t corner_vertex(const lam_mesh *mesh, size_t corner)
{
    return mesh->indices ? mesh->indices[corner] : (uint32_t)corner;
}

// --- computes fans at many positions in parallel lanes. The code is compiled once for each instruction
// set (meson.build). Every version is bit-identical to corner_fan.c.

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

// --- collects positions by their number of corners. As soon as enough positions have the same number, the normals at
// these positions are computed in parallel lanes. Positions with more than FAN_CORNERS_MAX corners, or
// with a degenerate triangle, are processed one by one. The two methods produce identical bits.

enum { FAN_ROWS = FAN_CORNERS_MAX * (FAN_CORNERS_MAX + 1) / 2 };

struct corner_fan_batch {
    uint32_t waiting[FAN_CORNERS_MAX + 1]; // number of positions for each number of corners
    fan_row rows[FAN_ROWS];                // the corners of the fans: a position with n corners needs n rows
    struct corner_fan_block block;
};

static inline void corner_fan_batch_start(struct corner_fan_batch *batch)
{
    for (uint32_t count = 0; count <= FAN_CORNERS_MAX; count++)
        batch->waiting[count] = 0;
}

// Adds a position with its corners, in any order; 0 < count ≤ FAN_CORNERS_MAX. Returns true if the row is full; the
// caller must then call corner_fan_batch_take.
static inline bool corner_fan_batch_add(struct corner_fan_batch *batch, const uint32_t *corners, uint32_t count)
{
    fan_row *rows = batch->rows + count * (count - 1) / 2;
    uint32_t p = batch->waiting[count]++;
    for (uint32_t i = 0; i < count; i++)
        rows[i][p] = corners[i];
    return p + 1 == FAN_POSITIONS;
}

// Moves the positions with `count` corners into batch->block. Returns false if there are none.
bool corner_fan_batch_take(struct corner_fan_batch *batch, uint32_t count);

#endif
