// resolve.h: converts a tile's fragments to pixels of the picture.
#ifndef RESOLVE_H
#define RESOLVE_H

#include "frame.h"
#include "pixels.h"
#include "tile.h"

// The picture, and the value of a pixel without fragments.
struct resolve_target {
    const struct frame *frame;
    lam_image *image;     // the picture in a working format (pixels.h), without pixels if `converted` is set
    lam_image *converted; // the caller's picture in another format, into which tiles are converted; or NULL
    uint8_t empty_pixel[16];
    const struct behind *behind; // if not NULL, the pixels are written to its first level, and the picture is unchanged
};

// Sums of a tile's pixels.
struct pixel_sums {
    float *sum[4];    // premultiplied r, g, b, and alpha
    float *unclipped; // LAM_OUTPUT_CLIPPED: the tile's pixels before clamping
    float *pixels;    // the tile's pixels before they are converted
    // The fraction of light that the translucent layers let through, for each sample.
    float *transmittance;
    // The same fraction for each channel, if surfaces of the frame transmit light; `transmittance` is then the mean of
    // the channels. Otherwise NULL.
    float *tint[3];
    const float *background;     // the background behind layers that transmit light (frame.glass_background)
    const struct behind *behind; // NULL while the picture behind glass is drawn, and if nothing is blurred or refracted
};

// Returns the number of bytes per pixel of a working format. Each return value is a constant, so that the compiler
// inlines short copies.
static inline size_t working_bytes(const lam_image *image) { return image->format == LAM_RGBA8 ? 4 : 16; }

// Returns a row of a tile in the picture.
static inline char *tile_row(const lam_image *image, const struct tile *tile, int y)
{
    return (char *)image_row(image, tile->y * TILE + y) + (size_t)tile->x * TILE * working_bytes(image);
}

#endif
