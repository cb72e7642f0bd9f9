// occlusion.h: ambient occlusion of every pixel from the depths of the surfaces around it.
//
// The visible surfaces are treated as a height field. Around a pixel, a plane through the view vector cuts the height
// field. In this plane, the horizon on either side bounds the part of the hemisphere that surrounding light comes from
// (Jimenez et al., "Practical Real-Time Strategies for Accurate Indirect Occlusion", 2016). The planes of 4 × 4
// neighbouring pixels are rotated by different angles, and an edge-aware filter averages the results.
// docs/lighting/occlusion.md lists the formulas. This header is the entry to this folder: other wings include only this
// header of the folder, and call only the functions that it declares (tests/structure.py).
#ifndef OCCLUSION_H
#define OCCLUSION_H

#include "buffer.h"
#include "frame.h"
#include "normals_memory.h"

struct pool;

// The grid of cells for which occlusion is computed. Usually, each pixel is a cell. In pictures of more than
// SCREEN_FINE pixels, a cell is two by two pixels, so occlusion is computed in a quarter of the time. The value of a
// pixel is then the mean of the surrounding cells that show the pixel's surface.
struct screen_occlusion {
    int width, height;           // the size of the picture
    int step;                    // pixels along the side of a cell: 1 or 2
    int grid_width, grid_height; // cells; cells at the picture's edge may be one pixel smaller
    int stride;                  // floats from row to row of a plane
    size_t plane;                // floats from plane to plane
    bool orthographic;
    float pixel_size, pixel_aspect; // as in struct frame
    float middle[2];                // the camera's axis, in pixels from the centre of the first pixel
    float radius;                   // radius of occlusion in eye units; 0 disables occlusion at this radius
    float cavity_radius;            // radius of cavity shading (lam_cavity)
    bool deepens;                   // whether cavity shading darkens valleys with the third power of their light
    // The distance of the visible surface in front of the eye at each pixel, or SCREEN_EMPTY: one plane for each pixel
    // of a cell (screen_pixel). The caller fills `depth`; screen_occlusion_start writes SCREEN_EMPTY around the
    // picture.
    float *depth;
    // For each cell, the signed distances of the nearest SCREEN_LAYERS surfaces at its first pixel, nearest first: back
    // faces are negative. The caller fills them. SCREEN_EMPTY: no further surface.
    float *layers;
    float *cell_depth; // for each cell, the depth of the first pixel that shows a surface
    // The slope of each cell's surface, computed together with the occlusion: the change of the distance from one cell
    // to the next.
    float *slope_x, *slope_y;
    float *noisy, *smoothed; // before and after the filter
    // The result, in the order of `depth` (with step 2, in the memory of `depth`): 1 if all surrounding light arrives,
    // 0 if none does.
    float *unoccluded;
};

// Larger than any distance; its square is a finite float.
#define SCREEN_EMPTY 1.0e17f

enum {
    SCREEN_FINE = 768 * 768,
    SCREEN_LAYERS = 3,
    OCCLUSION_ROWS = 16, // rows per task
};

// Returns the position of a pixel in `depth` and `unoccluded`.
static inline size_t screen_pixel(const struct screen_occlusion *o, int x, int y)
{
    int half = o->step - 1;
    return (size_t)((y & half) * 2 + (x & half)) * o->plane + (size_t)(y >> half) * (size_t)o->stride +
           (size_t)(x >> half);
}

// Returns the distance of a frame's ground at a pixel's centre, or SCREEN_EMPTY if the ground is not visible there.
static inline float screen_ground_depth(const struct frame *frame, int x, int y)
{
    const struct frame_ground *ground = &frame->ground;
    const float *up = ground->eye_up;
    float right = ((float)x + 0.5f - frame->middle[0]) * (frame->pixel_size * frame->pixel_aspect);
    float above = (frame->middle[1] - (float)y - 0.5f) * frame->pixel_size;
    float across = right * up[0] + above * up[1], depth;
    if (frame->orthographic) { // the point (right, above, -depth)
        depth = up[2] != 0 ? (across - ground->eye_height) / up[2] : SCREEN_EMPTY;
    } else { // the point depth · (right, above, -1)
        float along = across - up[2];
        depth = along != 0 ? ground->eye_height / along : SCREEN_EMPTY;
        right *= depth;
        above *= depth;
    }
    float dx = right - ground->eye_middle[0], dy = above - ground->eye_middle[1], dz = -depth - ground->eye_middle[2];
    float end = (float)ground->end;
    bool seen = depth > 0 || frame->orthographic;
    return seen && (dx * dx + dy * dy) + dz * dz < end * end ? depth : SCREEN_EMPTY;
}

// Initialises a picture's rows in `storage` without any surface, using the threads of `pool` (may be NULL). `lent`
// lists blocks of memory that nothing else uses during screen_occlusion_find. These blocks store as many planes of
// cells as fit.
bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct scratch_memory *lent,
                            int lent_count, struct buffer *storage, struct pool *pool, struct call_control *call,
                            lam_error *error);

// Computes `unoccluded` from `depth` with the threads of `pool` (may be NULL), for at most `lanes` cells at a time. If
// the call is stopped, the results are incomplete.
void screen_occlusion_find(struct screen_occlusion *occlusion, int lanes, struct pool *pool, struct call_control *call);

#endif
