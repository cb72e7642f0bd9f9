// shrink.h: small pictures of large ones.
#ifndef SHRINK_H
#define SHRINK_H

#include <lambent/image.h>

// Makes a picture (LAM_RGBA8) whose longer side has at most `most` pixels, of one that is linear and premultiplied (LAM_RGBA32F,
// lam_image_load_linear). It is never larger than `from`. The caller frees it. Error: LAM_LIMIT.
bool shrink_linear(const lam_image *from, int most, lam_image *to, lam_error *error);

// The same of a picture of bytes, LAM_RGBA8 without padding, sRGB-encoded. One that fits already is copied.
bool shrink_bytes(const lam_image *from, int most, lam_image *to, lam_error *error);

#endif
