// clip.h: marks vertices outside the view volume or the guard band, and clips triangles with such vertices.
#ifndef CLIP_H
#define CLIP_H

#include "bins.h"

// For a vertex that needs clipping, x is a NaN. The low bits of this NaN are flags. There is one flag for each plane;
// the flag is set if the vertex is outside this plane.
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

// Clips triangle t of a draw against each plane for which at least one corner is outside. Bins the resulting triangles
// with the number `id`.
void clip_triangle(const struct raster_frame *raster, struct thread_bins *bins, const struct frame_draw *draw,
                   uint32_t t, uint32_t id);

#endif
