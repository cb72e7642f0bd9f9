// explain_figure.h: draws an explained pixel as a figure: the picture with its vectors and a panel of numbers.
#ifndef EXPLAIN_FIGURE_H
#define EXPLAIN_FIGURE_H

#include "drawing.h"

#include <lambent/camera.h>
#include <lambent/explain.h>

struct explain_figure {
    const lam_explanation *explanation;
    const lam_camera *camera; // the camera that rendered the picture
    const lam_image *picture; // same size as the explanation
    const char *model;
    const char *title; // NULL means the names of the model and of the pixel
};

// Returns the size of the page in pixels.
void explain_figure_size(const struct explain_figure *figure, int *width, int *height);

// Draws the figure onto an open page of that size.
bool explain_figure_draw(const struct explain_figure *figure, struct drawing *drawing, lam_error *error);

#endif
