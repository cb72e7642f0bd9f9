// plot.h: curves over one axis, labelled: what the command `plot` computes (plot.c) and how it looks (plot_draw.c).
#ifndef PLOT_H
#define PLOT_H

#include "drawing.h"

enum { CURVES_MOST = 32 };

// y over x. It begins where it does and is drawn as far as the plot goes up.
struct curve {
    char label[120];
    uint32_t color;
    int style; // 0 drawn through, 1 long dashes, 2 short ones
    double (*value)(const struct curve *curve, double x);
    lam_light light; // for value: attenuation, spot
    lam_reflection reflection;
    float shininess;
    double below; // the first x where it is below 1/255, to float's precision; infinite: nowhere
    bool marked;  // a dot there, with its number
};

struct plot {
    const char *kind, *title, *x_label, *y_label;
    double x_most, y_most; // both axes begin at 0
    double level;          // a dashed line across; 0: none
    const char *level_label;
    struct curve curves[CURVES_MOST];
    int count;
};

// Draws it over the whole page.
bool plot_draw(const struct plot *plot, struct drawing *drawing, lam_error *error);

#endif
