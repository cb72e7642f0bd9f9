// raster_frame.h: what the raster steps share while they draw a frame.
#ifndef RASTER_FRAME_H
#define RASTER_FRAME_H

#include "frame.h"
#include "samples.h"
#include "tile.h"
#include "work.h"

// Units of parallel work: a range of vertices or triangles of one draw.
enum { VERTEX_PIECE = 8192, TRIANGLE_PIECE = 4096 };
struct piece {
    uint32_t draw, first, count;
};

// Read-only for the steps, apart from the vertices, which vertex_transform fills, and the work.
struct raster_frame {
    const struct frame *frame;
    const struct sample_pattern *pattern;
    struct work *work; // counted by any worker
    int tiles_across, tiles_down;
    bool without_glass; // surfaces that transmit are left out: the picture behind them
    // The guard band: |x| and |y| of a vertex, from the middle of the window and in multiples of w, up to which the
    // triangle needs no clipping.
    float guard[2];
    // x, y, key of each vertex of the meshes with indices: pixels (y down, not snapped), larger is nearer. Corners of other
    // meshes are transformed where they are needed (corners.inc).
    float *vertices;
    const uint32_t *first_vertex;   // of each draw with indices
    const struct thread_bins *bins; // of each thread
    int thread_count;
};

// Rounds to the nearest 1/256 pixel, clamped to ±2²⁹: corners that clip.c has cut from ones that were very far away can
// lie outside of the guard band.
static inline int32_t snap(float x)
{
    float t = x * 256.0f + 0.5f, max = 536870912.0f;
    t = t > -max ? t < max ? t : max : -max;
    int32_t i = (int32_t)t;
    return i - ((float)i > t);
}

#endif
