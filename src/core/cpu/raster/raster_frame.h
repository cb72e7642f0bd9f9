// raster_frame.h: data of a frame that the raster steps share.
#ifndef RASTER_FRAME_H
#define RASTER_FRAME_H

#include "frame.h"
#include "samples.h"
#include "tile.h"
#include "work.h"

// The sizes of parallel tasks. A task is a range of vertices or triangles of one draw.
enum { VERTEX_CHUNK = 8192, TRIANGLE_CHUNK = 4096 };
struct chunk {
    uint32_t draw, first, count;
};

// The steps change only two members: vertex_transform fills `vertices`, and the workers add to `work`.
struct raster_frame {
    const struct frame *frame;
    const struct sample_pattern *pattern;
    struct work *work; // the frame's work, to which every worker adds
    int tiles_across, tiles_down;
    bool without_glass; // surfaces that transmit light are omitted, to draw the picture behind these surfaces
    // The guard band: a triangle needs no clipping if |x| and |y| of its vertices are at most these values. x and y are
    // measured from the window's centre, in multiples of w.
    float guard[2];
    // x, y and key of each vertex of the indexed meshes. x and y are in pixels (y down, not snapped); larger keys are
    // nearer. Corners of other meshes are transformed on demand (corners.inc).
    float *vertices;
    const uint32_t *first_vertex;   // the first vertex of each indexed draw
    const struct thread_bins *bins; // the bins of each thread
    int thread_count;
};

// Rounds to the nearest 1/256 pixel and clamps to ±2²⁹. Clamping is necessary because corners that clip.c computes from
// very distant corners can be outside the guard band.
static inline int32_t snap(float x)
{
    float t = x * 256.0f + 0.5f, max = 536870912.0f;
    t = t > -max ? t < max ? t : max : -max;
    int32_t i = (int32_t)t;
    return i - ((float)i > t);
}

#endif
