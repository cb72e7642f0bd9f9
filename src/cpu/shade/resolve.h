// resolve.h: from a tile's fragments to pixels of the picture.
#ifndef RESOLVE_H
#define RESOLVE_H

#include "frame.h"
#include "tile.h"

// The picture, and the value of a pixel without fragments.
struct resolve_target {
    const struct frame *frame;
    lam_image *image;
    uint8_t empty_pixel[16];
};

// Sums of a tile's pixels.
struct pixel_sums {
    float *sum[4];    // r, g, b premultiplied, and alpha
    float *unclipped; // LAM_OUTPUT_CLIPPED: the tile's pixels before clamping
    // Of each sample: the fraction of light that the translucent layers let through.
    float *transmittance;
};

static inline size_t pixel_bytes(const lam_image *image) { return image->format == LAM_RGBA8 ? 4 : 16; }

// A row of a tile in the picture.
static inline char *tile_row(const lam_image *image, const struct tile *tile, int y)
{
    size_t x = (size_t)tile->x * TILE, row = (size_t)tile->y * TILE + (size_t)y;
    return (char *)image->pixels + (row * (size_t)image->width + x) * pixel_bytes(image);
}

#endif
