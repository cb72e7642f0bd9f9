// pixels.h: converts rows of pixels between formats. Code that processes pixels supports two working formats, LAM_RGBA8
// and LAM_RGBA32F; other formats are converted row by row.
#ifndef PIXELS_H
#define PIXELS_H

#include <lambent/image.h>

static inline bool format_is_float(lam_pixel_format format) { return format == LAM_RGBA32F || format == LAM_RGB32F; }

static inline lam_pixel_format working_format(lam_pixel_format format)
{
    return format_is_float(format) ? LAM_RGBA32F : LAM_RGBA8;
}

size_t pixel_bytes(lam_pixel_format format);
bool format_has_alpha(lam_pixel_format format);

// Returns the distance between rows in bytes, which is never 0.
static inline ptrdiff_t image_stride(const lam_image *image)
{
    return image->stride ? image->stride : (ptrdiff_t)((size_t)image->width * pixel_bytes(image->format));
}

static inline void *image_row(const lam_image *image, int y)
{
    return (char *)image->pixels + (ptrdiff_t)y * image_stride(image);
}

// Like lam_image_make, but allocates `more` additional bytes after the pixels.
bool image_make_larger(lam_image *image, int width, int height, lam_pixel_format format, size_t more, lam_error *error);

// Checks the pixels, the size, the format and the stride of a caller's picture. The error message begins with `what`.
bool image_check(const lam_image *image, const char *what, lam_error *error);

// Convert `count` pixels from a format to its working format, and back. With `raw`, the luminance is computed from the
// numbers as they are stored.
void pixels_to_working(lam_pixel_format format, const void *from, int count, void *to);
void pixels_from_working(lam_pixel_format format, bool raw, const void *from, int count, void *to);

// Gets the picture in its working format, without padding. `out` is the picture itself if possible, otherwise a copy.
// The caller frees `out`; freeing `out` releases memory only if `out` is a copy.
bool image_working(const lam_image *image, lam_image *out, lam_error *error);

// Makes a copy of a picture in its working format.
bool image_copy(const lam_image *image, lam_image *out, lam_error *error);

// Gets two pictures for comparison, each in its working format (see image_working). The pictures must have the same
// size, and either both must consist of bytes or both must consist of floats.
bool image_pair(const char *what, const lam_image *const given[2], lam_image pair[2], lam_error *error);

#endif
