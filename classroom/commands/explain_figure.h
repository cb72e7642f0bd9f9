// explain_figure.h: draws an explained pixel as a figure: the picture with its vectors, and its numbers beside it.
#ifndef EXPLAIN_FIGURE_H
#define EXPLAIN_FIGURE_H

#include "drawing.h"

struct explain_figure {
    const lam_explanation *explanation;
    const lam_camera *camera; // of the picture
    const lam_image *picture; // of the explanation's size
    const char *model;
    const char *title; // NULL: the model and the pixel
};

// The size of the page in pixels.
void explain_figure_size(const struct explain_figure *figure, int *width, int *height);

// Draws it onto an open page of that size.
bool explain_figure_draw(const struct explain_figure *figure, struct drawing *drawing, lam_error *error);

#endif
