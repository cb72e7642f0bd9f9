// behind.h: the picture behind rough and thick glass: all surfaces that do not transmit light, as linear light. Each
// level is half the size of the previous one, so that a lookup can blur the picture.
#ifndef BEHIND_H
#define BEHIND_H

#include "buffer.h"

enum { BEHIND_LEVELS = 24 };

// A texel is the mean of the pixels that it covers; all texels of a level have the same size, about 2^level pixels.
// Beyond the border, the border texels are used. Each texel consists of four floats: premultiplied light before
// exposure, and alpha.
struct behind {
    int levels;
    int width[BEHIND_LEVELS], height[BEHIND_LEVELS];
    float *texels[BEHIND_LEVELS];
    uint8_t *glass; // for each tile of the picture, whether surfaces were omitted in the tile
};

// Allocates all levels for a picture, and clears the first level and the flags of the tiles. Returns false if memory
// runs out.
bool behind_make(struct behind *behind, struct buffer *memory, int width, int height, size_t tiles,
                 struct call_control *call, lam_error *error);

// Computes the other levels from the first one.
void behind_fill(struct behind *behind);

// Samples the picture at x and y, in pixels from the upper left corner, blurred over √`square` pixels. The function
// interpolates between the two levels whose texels are about as wide as the blur. Each level is sampled with a cubic
// B-spline, except the first, which is sampled bilinearly.
void behind_look(const struct behind *behind, float x, float y, float square, float out[4]);

#endif
