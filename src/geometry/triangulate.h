// triangulate.h: splits polygons of any size, convex or not, into triangles.
//
// A triangle stays as it is, a quad is cut along the diagonal that lies inside it, a larger convex polygon becomes a fan;
// every other polygon is cut ear by ear in its dominant plane, snapped to a grid of integers so that every decision is
// exact. Simple polygons, also with collinear, repeated or touching points (holes joined by a bridge), are covered exactly;
// a polygon that has no area or crosses itself still gives count − 2 triangles. At most about count·√count steps; a polygon
// that needs more, because few points repeat or edges cross many times, is cut at its convex corners without further tests.
#ifndef TRIANGULATE_H
#define TRIANGULATE_H

#include "arena.h"
#include "call_control.h"

#include <stdbool.h>
#include <stdint.h>

// Scratch memory, kept from polygon to polygon. One for each thread.
struct triangulator {
    struct arena memory;
    struct call_control *call;
    void *block;
    size_t capacity; // bytes at block
};

void triangulator_start(struct triangulator *scratch, struct call_control *call); // `call` may be NULL
void triangulator_stop(struct triangulator *scratch);

// Splits the polygon whose corner i lies at positions[3·corners[i] …] (finite numbers), count ≥ 3, and writes count − 2
// triples of corner numbers (0 … count − 1, valid for every attribute) to `triples`, wound like the polygon. Returns
// false when memory has run out or the call must end (call_should_continue says which); never for up to four corners.
bool triangulate(struct triangulator *scratch, const float *positions, const uint32_t *corners, uint32_t count,
                 uint32_t *triples);

// The edges of one of these triples that no polygon of `count` corners has: bit k, that from its corner k to the next
// (lam_mesh.inner_edges).
static inline uint8_t triangulated_inner_edges(const uint32_t triple[3], uint32_t count)
{
    uint8_t inner = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t a = triple[k], b = triple[(k + 1) % 3], apart = a < b ? b - a : a - b;
        inner |= (uint8_t)((apart != 1 && apart != count - 1) << k);
    }
    return inner;
}

#endif
