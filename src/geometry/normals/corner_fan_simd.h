// corner_fan_simd.h: fans (corner_fan.h) at many positions side by side, compiled once for each width of
// registers. Every width gives the bits of corner_fan.c.
#ifndef CORNER_FAN_SIMD_H
#define CORNER_FAN_SIMD_H

#include "visible_normals.h"

#include <lambent/mesh.h>

#include <stddef.h>
#include <stdint.h>

enum {
    FAN_PLACES = 32, // positions side by side; gcc unrolls loops of 16 before it could make them wide
    FAN_FEW = 16,    // corners at one of them, at most
};

typedef uint32_t fan_numbers[FAN_PLACES];

// Positions where equally many corners meet, one in each lane: row i has their corners i.
struct fan_block {
    uint32_t count, places;       // corners at each, and how many there are; the lanes behind them repeat one
    fan_numbers corners[FAN_FEW]; // ascending at each position once they are looked at
    fan_numbers flat;             // not 0: a triangle there has no area, and nothing else is told of it
    // Of the fans, numbered at each position by their first corners: the corners as bits, 0: there is no such
    // fan; and the normals.
    uint32_t fans; // at the position with most
    fan_numbers members[FAN_FEW];
    float unit[FAN_FEW][3][FAN_PLACES];
    uint64_t elements[FAN_FEW][FAN_PLACES]; // where the corners' elements stand in seen_normals

    // On the way there.
    fan_numbers triangles[FAN_FEW], groups[FAN_FEW];
    fan_numbers next_vertex[FAN_FEW], before_vertex[FAN_FEW]; // the triangle's next corner, the one before
    float here[3][FAN_PLACES], next[FAN_FEW][3][FAN_PLACES], before[FAN_FEW][3][FAN_PLACES];
    double normal[FAN_FEW][3][FAN_PLACES];   // of the triangle, unit; zero without area
    double weighted[FAN_FEW][3][FAN_PLACES]; // the normal × twice the area × the angle at the corner
    fan_numbers links[FAN_FEW];              // bit j: the corner is joined to corner j
};

struct fan_lanes {
    int lanes; // floats in a register
    // Fills what follows from count, places and corners, but for the elements.
    void (*make)(struct fan_block *block, const lam_mesh *mesh, double least_cosine);
    // Then: fills the elements, and leaves as members only corners of triangles in the set, where triangle 0
    // has the number `first`. Returns how many fans have any.
    uint32_t (*find)(struct fan_block *block, const struct number_set *triangles, uint32_t first);
};

// The widest that the processor has, and not wider than `lanes`.
const struct fan_lanes *fan_lanes_of(int lanes);

#endif
