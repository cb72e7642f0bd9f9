// behind.h: the picture behind rough and thick glass: all surfaces but those that transmit, as linear light in levels of half the
// size each, so that a lookup can blur.
#ifndef BEHIND_H
#define BEHIND_H

#include "buffer.h"

enum { BEHIND_LEVELS = 24 };

// A texel has the mean of the pixels that it covers; all of a level have the same size, about 2^level pixels. Beyond the border those
// at the border count. Four floats each: premultiplied light before exposure, and alpha.
struct behind {
    int levels;
    int width[BEHIND_LEVELS], height[BEHIND_LEVELS];
    float *texels[BEHIND_LEVELS];
    uint8_t *glass; // of each tile of the picture: whether it has surfaces that were left out
};

// Reserves all levels for a picture, and clears the first, and the tiles' marks. False: out of memory.
bool behind_make(struct behind *behind, struct buffer *memory, int width, int height, size_t tiles,
                 struct call_control *call, lam_error *error);

// Makes the other levels from the first.
void behind_fill(struct behind *behind);

// The picture at x and y, in pixels from the upper left corner, blurred over the root of `square`, in pixels: between the two levels
// whose texels are about so wide, each under a cubic B-spline; the first level is read bilinearly.
void behind_look(const struct behind *behind, float x, float y, float square, float out[4]);

#endif
