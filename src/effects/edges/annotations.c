// annotations.c: draws dimensions, a scale bar, axes and a grid: strokes in pixels, and letters made of strokes, so that
// the picture has the same bytes on every machine and needs no font.
#include "edge_tasks.h"

#include "annotation_letter.h"
#include "linear.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GRID_LINES = 64 }; // in each direction, at most

struct pen {
    struct edge_task *task;
    double height; // of a letter, pixels
    int style;
};

struct place {
    double x, y; // pixels
};

// --- strokes and letters

static bool stroke(const struct pen *pen, double x0, double y0, double x1, double y1, double half)
{
    struct edge_stroke s = {.x = {x0, x1}, .y = {y0, y1}, .half = half, .style = pen->style, .round = {true, true}};
    struct edge_stroke halo = s;
    halo.half = half + 0.12 * pen->height;
    halo.style = EDGE_STYLE_HALO;
    struct call_control *call = pen->task->view->loop->call;
    return edge_stroke_add(pen->task->strokes, halo, call) && edge_stroke_add(pen->task->strokes, s, call);
}

static bool line(const struct pen *pen, struct place a, struct place b)
{
    double half = 0.05 * pen->height;
    return stroke(pen, a.x, a.y, b.x, b.y, half > 0.6 ? half : 0.6);
}

// The letters as lines between points of a grid of 5 × 7; "/" begins another line.
static const struct letter {
    char c;
    const char *lines;
    double width; // in units of the grid, with the space after the letter
} letters[] = {
    {'0', "103041453616050110", 6},
    {'1', "112026", 4},
    {'2', "01103041420646", 6},
    {'3', "01103041423313/334445361605", 6},
    {'4', "36300444", 6},
    {'5', "400002324345361605", 6},
    {'6', "413010010516364544331304", 6},
    {'7', "004016", 6},
    {'8', "13020110304142331304051636454433", 6},
    {'9', "051636454130100102133342", 6},
    {'.', "0606", 2},
    {'-', "0343", 6},
    {'+', "0444/2226", 6},
    {'e', "044443321203051646", 6},
    {'x', "0046/4006", 6},
    {'y', "0023/4023/2326", 6},
    {'z', "00400646", 6},
    {'m', "0602/03122326/23324346", 6},
    {'c', "4332120305163645", 6},
    {'i', "0602/0000", 2},
    {'n', "0602/0312324346", 6},
    {' ', "\0\0", 3},
};

static const struct letter *letter_of(char c)
{
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (letters[i].c == c)
            return &letters[i];
    return &letters[10]; // the decimal point of any language
}

static double text_width(const struct pen *pen, const char *text)
{
    double width = -2;
    for (; *text; text++)
        width += letter_of(*text)->width;
    return width * pen->height / 6;
}

// Draws text around a point, moved so that it lies inside the picture.
static bool text_at(const struct pen *pen, struct place middle, const char *text)
{
    const double *window = (double[2]){pen->task->view->frame->width, pen->task->view->frame->height};
    double unit = pen->height / 6, width = text_width(pen, text), margin = 0.6 * pen->height;
    double x = middle.x - width / 2, y = middle.y - pen->height / 2;
    x = x > window[0] - margin - width ? window[0] - margin - width : x;
    x = x < margin ? margin : x;
    y = y > window[1] - margin - pen->height ? window[1] - margin - pen->height : y;
    y = y < margin ? margin : y;
    for (; *text; text++) {
        const struct letter *letter = letter_of(*text);
        for (const char *p = letter->lines; p[2]; p += p[2] == '/' ? 3 : 2) {
            if (p[2] == '/')
                continue;
            if (!stroke(pen, x + (p[0] - '0') * unit, y + (p[1] - '0') * unit, x + (p[2] - '0') * unit,
                        y + (p[3] - '0') * unit, 0.075 * pen->height))
                return false;
        }
        x += letter->width * unit;
    }
    return true;
}

// Writes a length in model units, with the unit if the file defines it.
static void length_text(const struct frame *frame, double value, char text[32])
{
    static const struct {
        const char *symbol;
        double metres;
    } units[] = {{" m", 1}, {" cm", 0.01}, {" mm", 0.001}, {" in", 0.0254}};
    size_t i = 0, count = sizeof units / sizeof *units;
    while (i < count &&
           !(frame->edges.unit_m > 0.999 * units[i].metres && frame->edges.unit_m < 1.001 * units[i].metres))
        i++;
    snprintf(text, 32, value >= 1000 && value < 1e6 ? "%.0f%s" : "%.4g%s", value, i < count ? units[i].symbol : "");
}

// --- the box in the picture

// Projects a point. Returns false if it is not in front of the eye.
static bool project(const struct frame *frame, const double p[3], struct place *at)
{
    double q[4];
    for (int row = 0; row < 4; row++) {
        const double *m = frame->edges.pixel[row];
        q[row] = (m[0] * p[0] + m[1] * p[1]) + (m[2] * p[2] + m[3]);
    }
    if (!(q[3] > 1e-30))
        return false;
    *at = (struct place){q[0] / q[3], q[1] / q[3]};
    return at->x > -1e6 && at->x < 1e6 && at->y > -1e6 && at->y < 1e6;
}

static void corner_of(const struct frame *frame, int corner, double p[3])
{
    const lam_vec3 *low = &frame->edges.low, *high = &frame->edges.high;
    p[0] = corner & 1 ? high->x : low->x;
    p[1] = corner & 2 ? high->y : low->y;
    p[2] = corner & 4 ? high->z : low->z;
}

// Returns on which side of the line from a to b a point lies: the distance, positive or negative.
static double side_of(struct place a, struct place b, struct place p)
{
    double dx = b.x - a.x, dy = b.y - a.y, length = math_sqrt(dx * dx + dy * dy);
    return length > 0 ? (dx * (p.y - a.y) - dy * (p.x - a.x)) / length : 0;
}

// --- dimensions

// Chooses the edge of the box along an axis that is measured: one on the outline of the box in the picture, as far to
// the bottom as possible, or to the right if the edge is steep. Returns its first corner, or −1 if the axis points
// towards the eye. Sets `outward` to the unit vector away from the box.
static int edge_along(int axis, const struct place corners[8], double least, struct place *outward)
{
    int best = -1;
    double best_place = 0;
    for (int c = 0; c < 8; c++) {
        if (c >> axis & 1)
            continue;
        struct place a = corners[c], b = corners[c | 1 << axis];
        double dx = b.x - a.x, dy = b.y - a.y, length = math_sqrt(dx * dx + dy * dy), low = 0, high = 0;
        if (length < least)
            continue;
        for (int i = 0; i < 8; i++) {
            double side = side_of(a, b, corners[i]);
            low = side < low ? side : low;
            high = side > high ? side : high;
        }
        bool outline = low > -0.5 || high < 0.5, steep = dy * dy > 3 * dx * dx;
        double place = steep ? a.x + b.x : a.y + b.y;
        if (!outline || (best >= 0 && place <= best_place))
            continue;
        best = c;
        best_place = place;
        double sign = high > -low ? 1 : -1; // the box lies on this side of the edge
        *outward = (struct place){sign * dy / length, -sign * dx / length};
    }
    return best;
}

static bool arrow(const struct pen *pen, struct place a, struct place b)
{
    double dx = b.x - a.x, dy = b.y - a.y, length = math_sqrt(dx * dx + dy * dy);
    double along = 0.8 * pen->height, across = 0.28 * pen->height;
    if (!line(pen, a, b))
        return false;
    if (length < 2.5 * along)
        return true;
    double ux = dx / length, uy = dy / length;
    for (int k = 0; k < 2; k++) {
        struct place tip = k ? b : a;
        double turn = k ? -along : along;
        for (int s = -1; s <= 1; s += 2)
            if (!line(pen, tip,
                      (struct place){tip.x + turn * ux - s * across * uy, tip.y + turn * uy + s * across * ux}))
                return false;
    }
    return true;
}

static struct place moved(struct place p, struct place direction, double distance)
{
    return (struct place){p.x + distance * direction.x, p.y + distance * direction.y};
}

static bool draw_dimensions(const struct pen *pen)
{
    const struct frame *frame = pen->task->view->frame;
    const double size[3] = {frame->edges.high.x - frame->edges.low.x, frame->edges.high.y - frame->edges.low.y,
                            frame->edges.high.z - frame->edges.low.z};
    struct place corners[8], outward = {0};
    for (int c = 0; c < 8; c++) {
        double p[3];
        corner_of(frame, c, p);
        if (!project(frame, p, &corners[c]))
            return true; // the eye is inside the box, or beside it
    }
    for (int axis = 0; axis < 3; axis++) {
        int first = edge_along(axis, corners, pen->height, &outward);
        if (first < 0)
            continue;
        struct place a = corners[first], b = corners[first | 1 << axis];
        double gap = 0.4 * pen->height, offset = 1.6 * pen->height;
        struct place from = moved(a, outward, offset), to = moved(b, outward, offset);
        char text[32];
        length_text(frame, size[axis], text);
        double x = outward.x < 0 ? -outward.x : outward.x, y = outward.y < 0 ? -outward.y : outward.y;
        double reach = offset + (x * text_width(pen, text) + y * pen->height) / 2 + 0.7 * pen->height;
        struct place middle = moved((struct place){(a.x + b.x) / 2, (a.y + b.y) / 2}, outward, reach);
        if (!line(pen, moved(a, outward, gap), moved(a, outward, offset + gap)) ||
            !line(pen, moved(b, outward, gap), moved(b, outward, offset + gap)) || !arrow(pen, from, to) ||
            !text_at(pen, middle, text))
            return false;
    }
    return true;
}

// --- the scale bar and the axes

// Returns the pixels of one model unit across the view at the middle of the box, or 0.
static double pixels_per_unit(const struct frame *frame)
{
    const struct frame_edges *e = &frame->edges;
    const double middle[3] = {(e->low.x + e->high.x) / 2, (e->low.y + e->high.y) / 2, (e->low.z + e->high.z) / 2};
    const double *m = e->pixel[3];
    double w = (m[0] * middle[0] + m[1] * middle[1]) + (m[2] * middle[2] + m[3]), along = 0;
    for (int i = 0; i < 3; i++)
        along += e->pixel[0][i] * frame->eye_to_world[i][0];
    return w > 1e-30 ? along / w : 0;
}

static bool draw_scale_bar(const struct pen *pen)
{
    const struct frame *frame = pen->task->view->frame;
    double pixels = pixels_per_unit(frame), units = pixels > 0 ? 0.25 * frame->width / pixels : 0;
    if (!(units > 1e-290 && units < 1e290))
        return true;
    units = math_round_down(units);
    double length = units * pixels, margin = 1.2 * pen->height, tick = 0.4 * pen->height;
    struct place right = {frame->width - margin, frame->height - margin}, left = {right.x - length, right.y};
    char text[32];
    length_text(frame, units, text);
    return line(pen, left, right) &&
           line(pen, (struct place){left.x, left.y - tick}, (struct place){left.x, left.y + tick}) &&
           line(pen, (struct place){right.x, right.y - tick}, (struct place){right.x, right.y + tick}) &&
           text_at(pen, (struct place){(left.x + right.x) / 2, left.y - 1.2 * pen->height}, text);
}

static bool draw_axes(struct pen *pen)
{
    const struct frame *frame = pen->task->view->frame;
    double length = 3 * pen->height;
    struct place middle = {length + 2 * pen->height, frame->height - length - 2 * pen->height};
    for (int axis = 0; axis < 3; axis++) {
        double right = frame->eye_to_world[axis][0], up = frame->eye_to_world[axis][1];
        struct place tip = {middle.x + length * right, middle.y - length * up};
        struct place name = {middle.x + (length + 0.9 * pen->height) * right,
                             middle.y - (length + 0.9 * pen->height) * up};
        const char text[2] = {(char)('x' + axis), 0};
        pen->style = EDGE_STYLE_X + axis;
        if (!stroke(pen, middle.x, middle.y, tip.x, tip.y, 0.08 * pen->height) ||
            (right * right + up * up > 0.02 && !text_at(pen, name, text)))
            return false;
    }
    pen->style = EDGE_STYLE_INK;
    return true;
}

// --- the grid

static bool draw_grid(const struct pen *pen, void *scratch)
{
    const struct frame *frame = pen->task->view->frame;
    const struct frame_edges *e = &frame->edges;
    const double low[3] = {e->low.x, e->low.y, e->low.z}, high[3] = {e->high.x, e->high.y, e->high.z};
    const int axes[2] = {0, e->up == 2 ? 1 : 2};
    double radius = 0, first[2], count[2];
    for (int i = 0; i < 3; i++)
        radius += (high[i] - low[i]) * (high[i] - low[i]);
    radius = math_sqrt(radius) / 2;
    double square = radius > 1e-290 && radius < 1e290 ? math_round_down(0.3 * radius) : 0;
    for (int i = 0; square > 0 && i < 2; i++) {
        int64_t from = (int64_t)((low[axes[i]] - 0.6 * radius) / square - 1);
        first[i] = (double)from * square;
        count[i] = (double)((int64_t)((high[axes[i]] + 0.6 * radius) / square + 1) - from);
        if (!(count[i] > 0 && count[i] < GRID_LINES))
            square = 0; // far from the origin, compared to its size
    }
    if (!(square > 0))
        return true;
    double(*segments)[2][3] = malloc(2 * GRID_LINES * sizeof *segments);
    if (!segments)
        return false;
    int lines = 0;
    for (int i = 0; i < 2; i++)
        for (int n = 0; n <= (int)count[i]; n++, lines++)
            for (int end = 0; end < 2; end++) {
                double *p = segments[lines][end];
                p[e->up] = low[e->up] - 0x1p-12 * radius;
                p[axes[i]] = first[i] + n * square;
                p[axes[1 - i]] = first[1 - i] + (end ? count[1 - i] * square : 0);
            }
    bool ok = edge_task_segments(pen->task, segments, lines, EDGE_STYLE_GRID, scratch);
    free(segments);
    return ok;
}

bool annotations_draw(struct edge_task *task, void *scratch)
{
    const struct frame *frame = task->view->frame;
    const lam_draw_params *settings = &frame->settings;
    struct pen pen = {.task = task, .height = annotation_letter(frame->width, frame->height), .style = EDGE_STYLE_INK};
    return (!settings->grid || draw_grid(&pen, scratch)) && (!settings->dimensions || draw_dimensions(&pen)) &&
           (!settings->scale_bar || draw_scale_bar(&pen)) && (!settings->axes || draw_axes(&pen));
}
