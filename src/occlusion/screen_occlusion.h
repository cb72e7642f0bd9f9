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

struct pool;

// Rows of `stride` floats, one for each row of the picture, with room for LANES_MAX more after the last pixel.
struct screen_occlusion {
    int width, height, stride;
    bool orthographic;
    float pixel_size; // of a pixel in eye units, at distance 1 or, where orthographic, everywhere
    float radius;     // within which surfaces occlude, eye units
    // Distance in front of the eye of the surface at each pixel, SCREEN_EMPTY where there is none. To be filled by the
    // caller, with SCREEN_EMPTY beside the picture (screen_occlusion_start does that).
    float *depth;
    // Of the surface at each pixel, found with its occlusion: how the distance grows from pixel to pixel.
    float *slope_x, *slope_y;
    float *noisy, *smoothed; // before the filter, and after its first pass
    float *unoccluded;       // the result: 1 where all light from around arrives … 0 where none does
};

#define SCREEN_EMPTY 1.0e30f

// Rows of a piece of parallel work.
enum { OCCLUSION_ROWS = 16 };

// Sets up a picture's rows in `storage`, without any surface.
bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct buffer *storage,
                            struct call_control *call, lam_error *error);

// The steps (screen_occlusion.inc, compiled for each instruction set): for rows from `first` to before `end` the occlusion
// of each pixel, then the two passes of its filter. Each step takes all rows before the next begins.
struct occlusion_kernels {
    void (*occlude_rows)(const struct screen_occlusion *occlusion, int first, int end);
    void (*smooth_rows_across)(const struct screen_occlusion *occlusion, int first, int end);
    void (*smooth_rows_down)(const struct screen_occlusion *occlusion, int first, int end);
};

// Finds `unoccluded` from `depth`, by several threads (`pool` NULL: one). It ends early, unfinished, where the call should
// not continue.
void screen_occlusion_find(struct screen_occlusion *occlusion, const struct occlusion_kernels *kernels,
                           struct pool *pool, struct call_control *call);

#endif
