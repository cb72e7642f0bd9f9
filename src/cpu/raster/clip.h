// clip.h: marks vertices outside the view volume or the guard band, and clips their triangles.
#ifndef CLIP_H
#define CLIP_H

#include "bins.h"

// A vertex that needs clipping has x = NaN, whose low bits encode the planes that it is outside of.
enum outside {
    OUTSIDE_LEFT = 1,
    OUTSIDE_RIGHT = 2,
    OUTSIDE_TOP = 4,
    OUTSIDE_BOTTOM = 8,
    OUTSIDE_NEAR = 16,
    OUTSIDE_FAR = 32,
    OUTSIDE_ALL = 63,
};
#define OUTSIDE_NAN 0x7fc00000

// Clips triangle t of a draw (with the number `id`) against the planes that its corners violate, and bins the parts.
void clip_triangle(const struct raster_frame *raster, struct thread_bins *bins, const struct frame_draw *draw,
                   uint32_t t, uint32_t id);

#endif
