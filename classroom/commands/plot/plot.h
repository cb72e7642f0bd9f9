// plot.h: curves over one axis, labelled: computed by plot.c, drawn by plot_draw.c.
#ifndef PLOT_H
#define PLOT_H

#include "drawing.h"

enum { CURVES_MAX = 32 };

// A function y(x), clipped at the top of the plot.
struct curve {
    char label[120];
    uint32_t color;
    int style; // 0: solid, 1: long dashes, 2: short dashes
    double (*value)(const struct curve *curve, double x);
    lam_light light; // argument of value: attenuation, spot
    lam_reflection reflection;
    float shininess;
    double below; // the smallest x where the curve is below 1/255, to float precision; infinite: never
    bool marked;  // draw a dot there, with its number
};

struct plot {
    const char *kind, *title, *x_label, *y_label;
    double x_max, y_max; // both axes begin at 0
    double level;        // a dashed line across; 0: none
    const char *level_label;
    bool files_inside;
    lam_control control; // of files that are read // a scene file's
    struct curve curves[CURVES_MAX];
    int count;
};

// Draws it over the whole page.
bool plot_draw(const struct plot *plot, struct drawing *drawing, lam_error *error);

// Returns the kinds of plots, from 0, or NULL if the index is out of range.
const char *plot_kind(int index);

#endif
