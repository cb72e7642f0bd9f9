// plot.h: labelled curves with a common x axis, computed by plot.c and drawn by plot_draw.c.
#ifndef PLOT_H
#define PLOT_H

#include "drawing.h"

#include <lambent/device.h>
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
    double
        number[2]; // of fresnel: f0 or the index of refraction; depth: near and far; lobe: the roughness and the peak
    lam_tone tone;
    double below; // the smallest x at which the curve is below 1/255, infinity, or NaN if the curve does not fade
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

// Draws lobes as a polar figure, with n, l, r and h (plot_lobe.c). The light is at LOBE_LIGHT degrees from the normal.
#define LOBE_LIGHT 45
bool plot_draw_lobes(const struct plot *plot, struct drawing *drawing, lam_error *error);
// Adds a lobe, "phong:50", "blinn-phong:200", "ggx:0.3" or "lambert".
bool plot_add_lobe(struct plot *plot, const char *word, lam_error *error);

// --- parts of the command (plot.c) and of the drawing (plot_draw.c) that the lobes use

struct curve *plot_add_curve(struct plot *plot, double (*value)(const struct curve *, double), lam_error *error);
bool plot_wrong(lam_error *error, const char *kind, const char *word, const char *expected);
double plot_dash(const struct curve *curve, double unit);

#endif
