// highlight.h: finds the brightest highlight of a picture.
#ifndef HIGHLIGHT_H
#define HIGHLIGHT_H

#include <lambent/image.h>

// A rectangle of a picture, in pixels from its top left corner.
struct highlight {
    int left, top, width, height;
};

// Slides a window over the difference between `whole` and `matt` (both LAM_RGBA8 of the same size). This difference is
// the light that highlights add to the picture. Returns the rectangle around the brightest highlight. The width is 1 /
// `enlarged` of the picture's width, and the height is 1 / (2 `enlarged`) of the picture's height.
struct highlight highlight_find(const lam_image *whole, const lam_image *matt, int enlarged);

#endif
