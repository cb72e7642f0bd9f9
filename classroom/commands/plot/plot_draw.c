// plot_draw.c: draws a plot: axes with round numbers, a grid, the curves with their names, and the marks.
#include "plot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"

struct curve *plot_add_curve(struct plot *plot, double (*value)(const struct curve *, double), lam_error *error)
{
    if (plot->count == CURVES_MAX) {
        complain(error, LAM_LIMIT, "plot: more than %d curves, the most that can be distinguished", CURVES_MAX);
        return NULL;
    }
    struct curve *curve = &plot->curves[plot->count++];
    *curve = (struct curve){.value = value};
    return curve;
}

bool plot_wrong(lam_error *error, const char *kind, const char *word, const char *expected)
{
    return complain(error, LAM_BAD_ARGUMENT, "plot %s: found '%.100s', expected %s", kind, word, expected);
}

enum { INK = 0x222222, GREY = 0x707070, GRID = 0xe4e4e4, LEGEND_SIZE = 200 };

// The position of the axes on the page, and the scale of the text.
struct layout {
    double left, top, right, bottom; // pixels
    double unit;                     // 1 on a page of 800×500
};

static struct point place(const struct plot *plot, const struct layout *at, double x, double y)
{
    return (struct point){at->left + (at->right - at->left) * x / plot->x_max,
                          at->bottom - (at->bottom - at->top) * y / plot->y_max};
}

// Returns the spacing of the grid: 1, 2 or 5 times a power of ten, with at most `max_steps` steps.
static double step_of(double length, int max_steps)
{
    double power = 1;
    while (power > length / max_steps)
        power /= 10;
    while (power * 10 <= length / max_steps)
        power *= 10;
    static const double steps[] = {1, 2, 5, 10};
    for (int i = 0; i < 4; i++)
        if (length / (steps[i] * power) <= max_steps)
            return steps[i] * power;
    return 20 * power;
}

static bool draw_axes(const struct plot *plot, const struct layout *at, struct drawing *d, lam_error *error)
{
    double u = at->unit, x_step = step_of(plot->x_max, 10), y_step = step_of(plot->y_max, 6);
    char text[32];
    for (int i = 0; i * x_step <= plot->x_max * 1.000001; i++) {
        struct point foot = place(plot, at, i * x_step, 0), line[2] = {{foot.x, at->top}, foot};
        if (!draw_line(d, line, 2, u, GRID, 0, error))
            return false;
        snprintf(text, sizeof text, "%.6g", i * x_step);
        draw_text(d, (struct point){foot.x, foot.y + 20 * u}, 13 * u, ALIGN_MIDDLE, INK, text);
    }
    for (int i = 0; i * y_step <= plot->y_max * 1.000001; i++) {
        struct point foot = place(plot, at, 0, i * y_step), line[2] = {foot, {at->right, foot.y}};
        if (!draw_line(d, line, 2, u, GRID, 0, error))
            return false;
        snprintf(text, sizeof text, "%.6g", i * y_step);
        draw_text(d, (struct point){foot.x - 8 * u, foot.y + 4.5 * u}, 13 * u, ALIGN_RIGHT, INK, text);
    }
    struct point axes[3] = {{at->left, at->top}, {at->left, at->bottom}, {at->right, at->bottom}};
    if (!draw_line(d, axes, 3, 1.4 * u, INK, 0, error))
        return false;
    struct point middle = {(at->left + at->right) / 2, at->bottom + 46 * u};
    draw_text(d, middle, 15 * u, ALIGN_MIDDLE, INK, plot->x_label);
    draw_text(d, (struct point){d->width / 2.0, 32 * u}, 18 * u, ALIGN_MIDDLE, INK, plot->title);
    return draw_text_upwards(d, (struct point){24 * u, (at->top + at->bottom) / 2}, 15 * u, INK, plot->y_label, error);
}

double plot_dash(const struct curve *curve, double unit)
{
    return curve->style == 0 ? 0 : (curve->style == 1 ? 8 : 3) * unit;
}

// The points of a curve from left to right, subdivided where the curve is steep.
struct path {
    struct point *points; // in plot coordinates
    int count, room;
};

static bool path_add(struct path *path, double x, double y, lam_error *error)
{
    if (path->count == path->room) {
        int room = path->room ? 2 * path->room : 1024;
        struct point *points = realloc(path->points, (size_t)room * sizeof *points);
        if (!points)
            return complain(error, LAM_MACHINE, "out of memory");
        path->points = points;
        path->room = room;
    }
    path->points[path->count++] = (struct point){x, y};
    return true;
}

static bool path_refine(struct path *path, const struct plot *plot, const struct curve *curve, double x0, double y0,
                        double x1, double y1, lam_error *error)
{
    double rise = y1 > y0 ? y1 - y0 : y0 - y1;
    if (rise > plot->y_max * 0.01 && x1 - x0 > plot->x_max * 1e-5) {
        double x = (x0 + x1) / 2, y = curve->value(curve, x);
        return path_refine(path, plot, curve, x0, y0, x, y, error) &&
               path_refine(path, plot, curve, x, y, x1, y1, error);
    }
    return path_add(path, x1, y1, error);
}

// Draws the parts of the path below the plot's top edge.
static bool draw_path(const struct plot *plot, const struct layout *at, const struct curve *curve,
                      const struct path *path, struct drawing *d, lam_error *error)
{
    struct point *stroke = calloc((size_t)path->count + 2, sizeof *stroke);
    if (!stroke)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = true;
    int count = 0;
    for (int i = 0; ok && i < path->count; i++) {
        struct point p = path->points[i], before = path->points[i ? i - 1 : 0];
        bool in = p.y <= plot->y_max, was_in = before.y <= plot->y_max;
        double share = in != was_in ? (plot->y_max - before.y) / (p.y - before.y) : 0;
        struct point edge = {before.x + (p.x - before.x) * share, plot->y_max};
        if (in != was_in)
            stroke[count++] = place(plot, at, edge.x, edge.y);
        if (in)
            stroke[count++] = place(plot, at, p.x, p.y);
        if ((!in && was_in) || i + 1 == path->count) {
            ok = draw_line(d, stroke, count, 2.4 * at->unit, curve->color, plot_dash(curve, at->unit), error);
            count = 0;
        }
    }
    free(stroke);
    return ok;
}

static bool draw_curve(const struct plot *plot, const struct layout *at, const struct curve *curve, struct drawing *d,
                       lam_error *error)
{
    enum { STEPS = 400 };
    struct path path = {0};
    double x = 0, y = curve->value(curve, 0);
    // An inverse square is 0 at the light itself and unbounded next to the light, so the curve starts next to the
    // light.
    double beside = plot->x_max * 1e-4;
    if (y == 0 && curve->value(curve, beside) > plot->y_max)
        y = curve->value(curve, x = beside);
    bool ok = path_add(&path, x, y, error);
    for (int i = 1; ok && i <= STEPS; i++) {
        double next = plot->x_max * i / STEPS, value = curve->value(curve, next);
        ok = path_refine(&path, plot, curve, x, y, next, value, error);
        x = next;
        y = value;
    }
    ok = ok && draw_path(plot, at, curve, &path, d, error);
    free(path.points);
    return ok;
}

// Draws dots where curves fall below the level, and prints numbers above them, in several rows if the numbers would
// overlap.
static bool draw_marks(const struct plot *plot, const struct layout *at, struct drawing *d, lam_error *error)
{
    double u = at->unit, taken[CURVES_MAX] = {0}; // the right end of the numbers in each row
    for (int k = 0; k < CURVES_MAX; k++)
        taken[k] = -1e9;
    double last = -1;
    for (int n = 0; n < plot->count; n++) {
        // Find the next mark to the right.
        const struct curve *curve = NULL;
        int at_once = 0;
        for (int i = 0; i < plot->count; i++) {
            const struct curve *c = &plot->curves[i];
            bool shown = c->marked && c->below > last && c->below <= plot->x_max;
            if (shown && (!curve || c->below < curve->below)) {
                curve = c;
                at_once = 1;
            }
        }
        if (!at_once)
            break;
        last = curve->below;
        char text[48];
        snprintf(text, sizeof text, "%.4g", curve->below);
        double half = text_width(d, 13 * u, text) / 2 + 3 * u;
        struct point dot = place(plot, at, curve->below, plot->level);
        int row = 0;
        while (row + 1 < CURVES_MAX && dot.x - half < taken[row])
            row++;
        taken[row] = dot.x + half;
        double base = dot.y - (26 + 17 * row) * u;
        struct point stem[2] = {{dot.x, base + 3 * u}, dot};
        if (!draw_line(d, stem, 2, u, curve->color, 0, error) || !draw_dot(d, dot, 4 * u, curve->color, error))
            return false;
        draw_text(d, (struct point){dot.x, base}, 13 * u, ALIGN_MIDDLE, curve->color, text);
    }
    return true;
}

// Writes a curve's line in the legend. If the curve falls below 1/255 beyond the end of the x axis, the plot shows no
// dot, and the legend states the position instead.
static const char *legend_of(const struct plot *plot, const struct curve *curve, char text[LEGEND_SIZE])
{
    snprintf(text, LEGEND_SIZE, "%s", curve->label);
    if (curve->marked && curve->below > plot->x_max && curve->below < 1e30) {
        size_t used = strlen(text);
        snprintf(text + used, LEGEND_SIZE - used, " (below %s from %.4g)", plot->level_label, curve->below);
    }
    return text;
}

// The position of the legend: the top right corner of the plot if no curve crosses this corner, otherwise the space
// next to the plot.
struct names {
    double left, top, width, height; // pixels
};

static struct names place_names(const struct plot *plot, struct layout *at, const struct drawing *d)
{
    double u = at->unit, widest = 0;
    for (int i = 0; i < plot->count; i++) {
        char text[LEGEND_SIZE];
        double width = text_width(d, 14 * u, legend_of(plot, &plot->curves[i], text));
        widest = width > widest ? width : widest;
    }
    struct names box = {.top = at->top + 6 * u, .width = widest + 50 * u, .height = plot->count * 21 * u + 10 * u};
    box.left = at->right - 6 * u - box.width;
    double scale = plot->y_max / (at->bottom - at->top);
    double low = (at->bottom - box.top - box.height) * scale, high = (at->bottom - box.top) * scale;
    bool free = low > 0;
    for (int i = 0; free && i < plot->count; i++)
        for (int k = 0; free && k <= 100; k++) {
            double x = (box.left + box.width * k / 100 - at->left) / (at->right - at->left) * plot->x_max;
            double y = x < 0 ? high : plot->curves[i].value(&plot->curves[i], x);
            free = y < low || y > high;
        }
    if (!free && box.left > at->left + 200 * u) {
        at->right = box.left - 4 * u;
        box.left += 20 * u;
    }
    return box;
}

static bool draw_names(const struct plot *plot, const struct names *box, double u, struct drawing *d, lam_error *error)
{
    double left = box->left, top = box->top, row = 21 * u, swatch = 34 * u;
    draw_box(d, (struct point){left, top}, box->width, box->height, 0xffffff);
    for (int i = 0; i < plot->count; i++) {
        const struct curve *curve = &plot->curves[i];
        double base = top + (i + 1) * row;
        struct point line[2] = {{left + 8 * u, base - 5 * u}, {left + swatch, base - 5 * u}};
        if (!draw_line(d, line, 2, 2.4 * u, curve->color, plot_dash(curve, u), error))
            return false;
        char text[LEGEND_SIZE];
        draw_text(d, (struct point){left + swatch + 8 * u, base}, 14 * u, ALIGN_LEFT, INK,
                  legend_of(plot, curve, text));
    }
    return true;
}

// Draws a band for each depth curve: it is filled at the distances d at which surfaces at d and 1.001 d have the same
// depth in a buffer of 16 bits, so that they flicker (z-fighting).
static void draw_fights(const struct plot *plot, const struct layout *at, struct drawing *d)
{
    enum { COLUMNS = 1000 };
    double u = at->unit, width = (at->right - at->left) / COLUMNS, top = at->bottom + 66 * u;
    draw_text(d, (struct point){at->left, top}, 13 * u, ALIGN_LEFT, INK,
              "z-fighting, filled: surfaces at d and 1.001 d have the same depth of 16 bits");
    for (int i = 0; i < plot->count; i++) {
        const struct curve *c = &plot->curves[i];
        double band = top + (8 + 16 * i) * u;
        int from = -1; // the first column of a run
        draw_box(d, (struct point){at->left, band}, at->right - at->left, 11 * u, GRID);
        for (int k = 0; k <= COLUMNS; k++) {
            double x = plot->x_max * (k + 0.5) / COLUMNS;
            bool same = k < COLUMNS && x > c->number[0] && x * 1.001 < c->number[1] &&
                        (int)(65535 * c->value(c, x) + 0.5) == (int)(65535 * c->value(c, 1.001 * x) + 0.5);
            if (!same && from >= 0)
                draw_box(d, (struct point){at->left + width * from, band}, width * (k - from), 11 * u, c->color);
            from = !same ? -1 : from < 0 ? k : from;
        }
    }
}

bool plot_draw(const struct plot *plot, struct drawing *d, lam_error *error)
{
    double u = d->width / 800.0 < d->height / 500.0 ? d->width / 800.0 : d->height / 500.0;
    struct layout at = {
        .left = 78 * u, .top = 54 * u, .right = d->width - 30 * u, .bottom = d->height - 66 * u, .unit = u};
    bool depth = strcmp(plot->kind, "depth") == 0;
    at.bottom -= depth ? (26 + 16 * plot->count) * u : 0;
    struct names names = place_names(plot, &at, d);
    if (!draw_axes(plot, &at, d, error))
        return false;
    if (depth)
        draw_fights(plot, &at, d);
    if (plot->level > 0) {
        struct point across[2] = {place(plot, &at, 0, plot->level), place(plot, &at, plot->x_max, plot->level)};
        if (!draw_line(d, across, 2, u, GREY, 4 * u, error))
            return false;
        draw_text(d, (struct point){across[1].x - 4 * u, across[1].y - 6 * u}, 12 * u, ALIGN_RIGHT, GREY,
                  plot->level_label);
    }
    for (int i = 0; i < plot->count; i++)
        if (!draw_curve(plot, &at, &plot->curves[i], d, error))
            return false;
    return draw_marks(plot, &at, d, error) && draw_names(plot, &names, u, d, error);
}
