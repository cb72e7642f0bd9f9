// fragments.h: a tile's fragments, one for each pixel and each triangle that is visible in this pixel.
#ifndef FRAGMENTS_H
#define FRAGMENTS_H

#include "frame.h"
#include "tile.h"

// Rows with one entry for each fragment. visibility_resolve and translucent_fragments list fragments, group_fragments
// groups them, and shade_fragments fills in the colours.
struct fragments {
    int count;
    uint32_t *id;    // triangle number; BACK_SIDE is set if the back is visible
    uint16_t *pixel; // y·TILE + x
    uint8_t *weight; // number of samples that show the triangle
    uint8_t *sample; // the index of the sample that is nearest to the pixel's centre
    uint32_t *group; // surface·2 + back
    uint32_t *order; // fragment indices sorted by group
    float *color[4]; // r, g, b, a; not premultiplied
    // For translucent fragments, if surfaces of the frame transmit light: the transmittance of each channel. Otherwise
    // NULL.
    float *through[3];
    // For translucent fragments, if the frame refracts: the offset, in pixels to the right and down, at which the
    // picture behind is read. The third value is the square of the blur width in pixels, or −1 if the surface does not
    // transmit light.
    float *bend[3];
    // Scratch memory of the current step: three words for each fragment.
    uint32_t *scratch;
};

// Finds the group of each fragment, and sorts the fragments by group. With `by_pixel`, all fragments sorted by pixel, the
// fragments of a group are sorted by pixel and triangle, otherwise in the order of the list.
void group_fragments(const struct frame *frame, struct fragments *fragments, const uint32_t *by_pixel);

#endif
