// png_whole.h: the usual PNG pictures read at once.
#ifndef PNG_WHOLE_H
#define PNG_WHOLE_H

#include "codec.h"

static inline uint32_t png_u32_at(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

// Fills an image of bytes from a PNG of 1, 3 or 4 channels of 8 bits, not interlaced, whose chunks before the pixels are in order. False:
// another reader has to read it, and to name what is wrong.
bool png_read_whole(const struct picture_file *file, int channels, lam_image *image);

#endif
