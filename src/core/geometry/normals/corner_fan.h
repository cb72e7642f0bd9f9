// corner_fan.h: computes the normals at one position from the adjacent corners.
#ifndef CORNER_FAN_H
#define CORNER_FAN_H

#include "arena.h"

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

#endif
