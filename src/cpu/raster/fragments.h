// fragments.h: a tile's fragments: each pixel with each triangle that it shows.
#ifndef FRAGMENTS_H
#define FRAGMENTS_H

#include "frame.h"
#include "tile.h"

// Rows with one entry for each fragment. visibility_resolve and translucent_fragments list them, group_fragments
// groups them, and shade_fragments fills in the colours.
struct fragments {
    int count;
    uint32_t *id;    // triangle number with BACK_SIDE
    uint16_t *pixel; // y·TILE + x
    uint8_t *weight; // number of samples that show the triangle
    uint8_t *sample; // the one of them nearest to the pixel's centre
    uint32_t *group; // surface·2 + back
    uint32_t *order; // fragments sorted by group
    float *color[4]; // r, g, b, a; not premultiplied
    // Of translucent fragments, where the frame transmits: the share of each channel that goes through; NULL elsewhere.
    float *through[3];
    // The same where the frame refracts: by how many pixels what is behind is moved to the right and down, and the square of the
    // width in pixels over which it is blurred; −1: the surface does not transmit.
    float *bend[3];
    // Scratch of the step that runs: three words for each fragment.
    uint32_t *scratch;
};

// Finds the group of each fragment, and the order by group.
void group_fragments(const struct frame *frame, struct fragments *fragments);

#endif
