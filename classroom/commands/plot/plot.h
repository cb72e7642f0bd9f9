// plot.h: labelled curves with a common x axis, computed by plot.c and drawn by plot_draw.c.
#ifndef PLOT_H
#define PLOT_H

#include "drawing.h"

#include <lambent/light.h>
#include <lambent/reflection.h>

enum { CURVES_MAX = 32 };

// A function y(x), clipped at the top of the plot.
struct curve {
    char label[120];
    uint32_t color;
    int style; // 0 is solid, 1 long dashes, 2 short dashes
    double (*value)(const struct curve *curve, double x);
    lam_light light; // the argument of `value` for attenuation and spot
    lam_reflection reflection;
    float shininess;
    double below; // the smallest x at which the curve is below 1/255, or infinity
    bool marked;  // whether a dot labelled with `below` is drawn at this x
};

struct plot {
    const char *kind, *title, *x_label, *y_label;
    double x_max, y_max; // both axes start at 0
    double level;        // the height of a dashed line; 0 means no line
    const char *level_label;
    bool files_inside;   // whether scene files are restricted to their folder
    lam_control control; // the limits for reading files
    struct curve curves[CURVES_MAX];
    int count;
};

// Draws the plot over the whole page.
bool plot_draw(const struct plot *plot, struct drawing *drawing, lam_error *error);

#endif
