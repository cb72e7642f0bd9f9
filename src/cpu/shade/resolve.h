// resolve.h: from a tile's fragments to pixels of the picture.
#ifndef RESOLVE_H
#define RESOLVE_H

#include "frame.h"
#include "pixels.h"
#include "tile.h"

// The picture, and the value of a pixel without fragments.
struct resolve_target {
    const struct frame *frame;
    lam_image *image;     // of a working format (pixels.h); without pixels where `converted` is set
    lam_image *converted; // the caller's picture of another format, into which tiles are converted; or NULL
    uint8_t empty_pixel[16];
    const struct behind *behind; // its first level gets the sums in place of the picture; or NULL
};

// Sums of a tile's pixels.
struct pixel_sums {
    float *sum[4];    // r, g, b premultiplied, and alpha
    float *unclipped; // LAM_OUTPUT_CLIPPED: the tile's pixels before clamping
    float *pixels;    // the tile's pixels before they are converted
    // Of each sample: the fraction of light that the translucent layers let through.
    float *transmittance;
    // The same for each channel, where the frame transmits; then `transmittance` is their mean. NULL: it does not.
    float *tint[3];
    const float *background;     // what such layers are in front of (frame.glass_background)
    const struct behind *behind; // NULL: nothing is blurred or bent, or this picture is the one behind
};

// Of the two working formats: constants, with which short copies are inlined.
static inline size_t working_bytes(const lam_image *image) { return image->format == LAM_RGBA8 ? 4 : 16; }

// A row of a tile in the picture.
static inline char *tile_row(const lam_image *image, const struct tile *tile, int y)
{
    return (char *)image_row(image, tile->y * TILE + y) + (size_t)tile->x * TILE * working_bytes(image);
}

#endif
