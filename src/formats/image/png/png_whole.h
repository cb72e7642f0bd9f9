// png_whole.h: reads all pixels of common PNG files in one step.
#ifndef PNG_WHOLE_H
#define PNG_WHOLE_H

#include "codec.h"

static inline uint32_t png_u32_at(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

// Fills an image (LAM_RGBA8 or LAM_RGB8) from a PNG file that is not interlaced and has 1, 3 or 4 channels of 8 bits (4
// only for LAM_RGBA8). The chunks before the pixels must have been checked. The image needs png_whole_extra more bytes
// after its pixels, because the rows of the file are unfiltered in place. If the function returns false, libspng must
// read the picture and report the error.
bool png_read_whole(const struct picture_file *file, int channels, lam_image *image);
size_t png_whole_extra(uint32_t width, uint32_t height, lam_pixel_format format, int channels);

#endif
