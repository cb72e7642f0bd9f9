// screen_occlusion.h: ambient occlusion of every pixel from the distances of the surfaces around it.
//
// The picture's surfaces are taken as a landscape of heights, as the eye sees it. Around a pixel a plane through the
// view vector cuts that landscape; in it the horizon to either side bounds the part of the hemisphere that light
// from all around comes from (Jimenez et al., "Practical Real-Time Strategies for Accurate Indirect Occlusion", 2016).
// Sixteen neighbours turn their slices by different angles, and a filter of that size that stops at edges averages them.
// docs/lighting/occlusion.md has the formulas.
#ifndef SCREEN_OCCLUSION_H
#define SCREEN_OCCLUSION_H

#include "buffer.h"
#include "frame.h"
#include "occlusion_pattern.h"
#include "scratch_memory.h"

struct pool;

// The grid of cells that occlusion is found for: the picture's pixels or, in pictures of more than SCREEN_FINE pixels, cells of
// two by two of them, which take a quarter of the time; their pixels then have the mean of the cells around that lie on
// the same surface.
struct screen_occlusion {
    int width, height;           // of the picture
    int step;                    // 1, or 2: pixels to a side of a cell
    int grid_width, grid_height; // cells; those at the picture's edge may have one pixel less
    int stride;                  // floats from row to row of a plane
    size_t plane;                // floats from plane to plane
    bool orthographic;
    float pixel_size;    // of a pixel in eye units, at distance 1 or, where orthographic, everywhere
    float radius;        // within which surfaces occlude, eye units; 0: there is none of this size
    float cavity_radius; // the same of the cavity (lam_cavity)
    bool ridges;         // the cavity's ridges are lighter
    // Distance in front of the eye of the surface at each pixel, SCREEN_EMPTY if there is none: a plane for each pixel
    // of a cell (screen_pixel). To be filled by the caller, with SCREEN_EMPTY beside the picture
    // (screen_occlusion_start does that).
    float *depth;
    float *cell_depth; // of each cell: the first of its pixels that shows a surface
    // Of the surface of each cell, found with its occlusion: how the distance grows from cell to cell.
    float *slope_x, *slope_y;
    float *noisy, *smoothed; // before the filter, and after its first pass
    // The result, in the order of `depth` and, with step 2, in its memory: 1 if all light from around arrives … 0 if
    // none does, and more than 1 on ridges.
    float *unoccluded;
};

// Farther than any surface; its square is a float.
#define SCREEN_EMPTY 1.0e17f

enum {
    SCREEN_FINE = 512 * 512,
    OCCLUSION_ROWS = 16, // of a piece of parallel work
};

// Where a pixel is in `depth` and `unoccluded`.
static inline size_t screen_pixel(const struct screen_occlusion *o, int x, int y)
{
    int half = o->step - 1;
    return (size_t)((y & half) * 2 + (x & half)) * o->plane + (size_t)(y >> half) * (size_t)o->stride +
           (size_t)(x >> half);
}

// Returns the distance of a frame's ground at a pixel's centre, SCREEN_EMPTY if it is not visible.
static inline float screen_ground_depth(const struct frame *frame, int x, int y)
{
    const struct frame_ground *ground = &frame->ground;
    const float *up = ground->eye_up;
    float right = ((float)x + 0.5f - 0.5f * (float)frame->width) * frame->pixel_size;
    float above = (0.5f * (float)frame->height - (float)y - 0.5f) * frame->pixel_size;
    float across = right * up[0] + above * up[1], depth;
    if (frame->orthographic) { // the point (right, above, -depth)
        depth = up[2] != 0 ? (across - ground->eye_height) / up[2] : SCREEN_EMPTY;
    } else { // the point depth (right, above, -1)
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

// Sets up a picture's rows in `storage`, without any surface, by several threads (`pool` NULL: one). `lent` is memory,
// if any, that nothing else uses from screen_occlusion_find on until the result has been read; the cells lie there if
// it is large enough.
bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct scratch_memory lent,
                            struct buffer *storage, struct pool *pool, struct call_control *call, lam_error *error);

// The steps (screen_occlusion.inc, compiled for each instruction set), for rows of cells from `first` to before `end`: the
// depth of each cell (with step 2), its occlusion, the two passes of its filter, and its pixels. Each step takes all rows
// before the next begins.
struct occlusion_kernels {
    void (*cell_rows)(const struct screen_occlusion *occlusion, int first, int end);
    void (*occlude_rows)(const struct screen_occlusion *occlusion, int first, int end);
    void (*smooth_rows_across)(const struct screen_occlusion *occlusion, int first, int end);
    void (*smooth_rows_down)(const struct screen_occlusion *occlusion, int first, int end);
    void (*pixel_rows)(const struct screen_occlusion *occlusion, int first, int end);
};

// Finds `unoccluded` from `depth`, by several threads (`pool` NULL: one). It ends early, unfinished, where the call should
// not continue.
void screen_occlusion_find(struct screen_occlusion *occlusion, const struct occlusion_kernels *kernels,
                           struct pool *pool, struct call_control *call);

#endif
