// highlight.h: where the brightest highlight of a picture is.
#ifndef HIGHLIGHT_H
#define HIGHLIGHT_H

#include <lambent/lambent.h>

// A part of a picture, in pixels from its top left corner.
struct highlight {
    int left, top, width, height;
};

// Slides a window over the light that the highlights add to a picture, `whole` − `matt`, both LAM_RGBA8 of one size.
// The result is the area around the brightest highlight, 1 / `enlarged` of the picture's width and 1 / (2 `enlarged`)
// of its height.
struct highlight highlight_find(const lam_image *whole, const lam_image *matt, int enlarged);

#endif
