// triangulate.h: splits polygons of any size, convex or not, into triangles.
//
// A triangle is unchanged, a quad is split along its inner diagonal, and a larger convex polygon becomes a fan. Every
// other polygon is projected onto its dominant plane, snapped to an integer grid so that every decision is exact, and
// cut ear by ear. Simple polygons are covered exactly, even if points are collinear, repeated or touching (holes joined
// by a bridge). A polygon without area or with self-intersections still gives count − 2 triangles. The function takes
// at most about count·√count steps. A polygon that needs more steps, because of repeated points or many crossing edges,
// is then cut at its convex corners without further tests.
#ifndef TRIANGULATE_H
#define TRIANGULATE_H

#include "arena.h"
#include "call_control.h"

#include <stdbool.h>
#include <stdint.h>

// Scratch memory of one thread, reused for all its polygons.
struct triangulator {
    struct arena memory;
    struct call_control *call;
    void *block;
    size_t capacity; // size of the block in bytes
};

// `call` may be NULL. The scratch memory does not count towards its memory limit.
void triangulator_start(struct triangulator *scratch, struct call_control *call);
void triangulator_stop(struct triangulator *scratch);

// Splits a polygon into triangles. Corner i of the polygon is at positions[3·corners[i] …], which must be finite, and
// `count` is at least 3. Writes count − 2 triples of corner numbers to `triples`, with the same winding as the polygon.
// The numbers are 0 … count − 1, so they can be used for every attribute. Returns false if memory runs out, or if
// call_should_continue returns false. The function never fails for at most four corners.
bool triangulate(struct triangulator *scratch, const float *positions, const uint32_t *corners, uint32_t count,
                 uint32_t *triples);

// Returns which edges of a triangle are inside the polygon with `count` corners. Bit k is the edge from corner k to the
// next corner (lam_mesh.inner_edges).
static inline uint8_t triangulated_inner_edges(const uint32_t triple[3], uint32_t count)
{
    uint8_t inner = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t a = triple[k], b = triple[(k + 1) % 3], distance = a < b ? b - a : a - b;
        inner |= (uint8_t)((distance != 1 && distance != count - 1) << k);
    }
    return inner;
}

#endif
