// shrink.h: reduces large pictures.
#ifndef SHRINK_H
#define SHRINK_H

#include <lambent/image.h>

// Makes a reduced picture (LAM_RGBA8) whose longer side has at most `most` pixels. `from` is linear and premultiplied
// (LAM_RGBA32F, lam_image_load_linear). The result is never larger than `from`. The caller frees the result. Fails with
// LAM_LIMIT.
bool shrink_linear(const lam_image *from, int most, lam_image *to, lam_error *error);

// Like shrink_linear, but for a picture in LAM_RGBA8 without padding, encoded in sRGB. Copies a picture that already
// fits.
bool shrink_bytes(const lam_image *from, int most, lam_image *to, lam_error *error);

#endif
