// edge_lines.c: draws the edges of a task: selects the edges to draw, clips them to the picture, and finds their
// visible parts.
#include "edge_tasks.h"

#include "fail.h"
#include "linear.h"

#include <stdlib.h>

enum {
    POINTS_PER_LINE = 32768,
    POINTS = 2 * POINTS_PER_LINE,
    HALVINGS = 4, // number of bisections: the end of a visible part is found to 1/32 of a pixel
};

// The scratch memory of one thread.
struct scratch {
    struct edge_line lines[EDGES_PER_TASK];
    struct edge_point points[POINTS];
    uint8_t hidden[POINTS];
    // A change of visibility along a line, between the fractions `from` and `to` of its length.
    struct change {
        double from, to;
        uint8_t hidden; // whether the line is hidden at `from`
    } changes[POINTS];
    struct edge_point middles[POINTS];
    uint8_t middle_hidden[POINTS];
    uint32_t line_count, point_count;
};

size_t edge_scratch_bytes(void) { return (sizeof(struct scratch) + 63) / 64 * 64; }

// --- selecting edges

static double dot(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static void position(const struct edge_task *task, uint32_t corner, double p[3])
{
    const lam_mesh *mesh = task->draw->mesh;
    frame_to_world(task->draw, mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[corner] : corner), p);
    ray_point(task->view->hierarchy, p, p);
}

// Computes a triangle's normal, not normalized, in the hierarchy's space. If the draw is mirrored, reverses the normal.
// Returns whether the normal points to the eye's side.
static bool faces_eye(const struct edge_task *task, uint32_t triangle, double n[3])
{
    const struct edge_view *view = task->view;
    double p[3][3], to_eye[3];
    for (uint32_t k = 0; k < 3; k++)
        position(task, 3 * triangle + k, p[k]);
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
        n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
        to_eye[i] = view->frame->orthographic ? view->eye[i] : view->eye[i] - p[0][i];
    }
    for (int i = 0; i < 3 && task->draw->mirrored; i++)
        n[i] = -n[i];
    return dot(n, to_eye) > 0;
}

static bool is_culled(const struct frame_draw *draw, bool front)
{
    return draw->cull == (front ? LAM_CULL_FRONT : LAM_CULL_BACK);
}

// Returns the style of an edge that is not a feature edge and is not culled, or −1 if the edge is not drawn.
static int plain_style(const struct edge_task *task, const struct mesh_edge *edge)
{
    return task->view->frame->settings.wireframe && !(edge->kind & EDGE_INNER) ? EDGE_STYLE_WIREFRAME : -1;
}

// Returns the style of an edge, or −1 if the edge is not drawn. Stores the LAM_EDGES_… bits of a feature edge in
// *kinds_of.
static int style_of(const struct edge_task *task, const struct mesh_edge *edge, unsigned *kinds_of)
{
    const lam_draw_params *settings = &task->view->frame->settings;
    int plain = plain_style(task, edge);
    bool culls = task->draw->cull != LAM_CULL_NONE;
    if (!settings->edges && !culls)
        return plain;
    double a[3], b[3];
    bool front[2] = {faces_eye(task, edge->corner / 3, a), false};
    front[1] = edge->kind & EDGE_OPEN ? front[0] : faces_eye(task, edge->other / 3, b);
    if (culls && !(edge->kind & EDGE_SHARED) && is_culled(task->draw, front[0]) && is_culled(task->draw, front[1]))
        return -1;
    unsigned kinds = 0;
    if (edge->kind & (EDGE_OPEN | EDGE_SHARED)) {
        kinds = edge->kind & EDGE_OPEN ? LAM_EDGES_BOUNDARY : LAM_EDGES_CREASE;
    } else {
        double turn = edge->kind & EDGE_ALIKE ? -1 : 1, size = math_sqrt(dot(a, a)) * math_sqrt(dot(b, b));
        bool sharp = size > 0 && turn * dot(a, b) < task->view->frame->edges.min_cosine * size;
        kinds |= sharp || edge->kind & EDGE_CUT ? LAM_EDGES_CREASE : 0;
    }
    if (edge->kind & EDGE_INNER)
        kinds = 0;
    if (!(edge->kind & (EDGE_OPEN | EDGE_SHARED)) && front[0] != (edge->kind & EDGE_ALIKE ? !front[1] : front[1]))
        kinds |= LAM_EDGES_SILHOUETTE;
    *kinds_of = kinds & (unsigned)settings->edges;
    return *kinds_of ? EDGE_STYLE_FEATURE : plain;
}

// Returns the style of an edge whose weight is known. Specks have the style of edges that are not feature edges.
static int drawn_style(const struct edge_task *task, uint32_t e)
{
    unsigned kinds;
    uint16_t weight = task->weights ? task->weights[e] : EDGE_UNWEIGHED;
    if (weight == EDGE_SPECK)
        return plain_style(task, &task->edges[e]);
    if (weight != EDGE_UNWEIGHED)
        return EDGE_STYLE_FEATURE;
    // A feature edge without a weight is outside the picture.
    return task->weights && !task->view->frame->settings.wireframe ? -1 : style_of(task, &task->edges[e], &kinds);
}

// --- clipping to the picture

// Cuts off the part of a line in which a·q is below 0. `at_0` and `at_1` are a·q at the two ends. Returns false if
// nothing of the line remains.
static bool cut(double at_0, double at_1, double range[2])
{
    if (at_0 >= 0 && at_1 >= 0)
        return true;
    if (!(at_0 >= 0) && !(at_1 >= 0))
        return false;
    double t = at_0 / (at_0 - at_1);
    if (at_0 >= 0)
        range[1] = t < range[1] ? t : range[1];
    else
        range[0] = t > range[0] ? t : range[0];
    return range[0] < range[1];
}

// Computes a position's window coordinates X·w, Y·w, z, w.
static void to_window(const struct edge_view *view, const double p[3], double q[4])
{
    const struct hierarchy *h = view->hierarchy;
    for (int row = 0; row < 4; row++) {
        const double *m = view->frame->edges.pixel[row];
        double world[3];
        for (int i = 0; i < 3; i++)
            world[i] = p[i] / h->scale + h->centre[i];
        q[row] = dot(m, world) + m[3];
    }
}

// Returns the height of a triangle over one of its edges, in pixels: the distance of the third corner from the edge. If
// that corner is not in front of the eye, the result is large.
static double height_over(const struct edge_task *task, uint32_t corner, const struct edge_line *line)
{
    double p[3], q[4];
    position(task, edge_end(edge_end(corner)), p);
    to_window(task->view, p, q);
    if (!(q[3] > 1e-30) || !(line->length > 0))
        return 1e30;
    double dx = q[0] / q[3] - line->x[0], dy = q[1] / q[3] - line->y[0];
    double across = (line->x[1] - line->x[0]) * dy - (line->y[1] - line->y[0]) * dx;
    return (across < 0 ? -across : across) / line->length;
}

// If both triangles of a wireframe edge are narrower than FADE line widths, the line is drawn proportionally thinner,
// down to 1/FADE of its width. A fine mesh therefore looks evenly grey instead of black.
enum { FADE = 5 };
static double half_width(const struct edge_task *task, const struct mesh_edge *edge, const struct edge_line *line)
{
    double width = task->view->frame->edges.width[line->style];
    if (line->style != EDGE_STYLE_WIREFRAME)
        return width / 2;
    double a = height_over(task, edge->corner, line), b = height_over(task, edge->other, line);
    double share = (a > b ? a : b) / (FADE * width), least = 1.0 / FADE;
    return (share < least ? least : share < 1 ? share : 1) * width / 2;
}

// Clips a segment to the picture, with its ends in the hierarchy's space. Sets all members of the line except the
// points. Returns false if the segment is outside the picture.
static bool set_segment(const struct edge_view *view, const double p[2][3], int style, struct edge_line *line)
{
    const struct frame_edges *edges = &view->frame->edges;
    double q[2][4], range[2] = {0, 1}, margin = edges->width[style] + 1;
    for (int k = 0; k < 2; k++)
        to_window(view, p[k], q[k]);
    double tiny[2] = {q[0][3] - 1e-30, q[1][3] - 1e-30}; // w > 0
    double right = view->window[0] + margin, below = view->window[1] + margin;
    bool planes = style != EDGE_STYLE_GRID; // the grid continues beyond the planes, which are fitted to the model
    if (!cut(tiny[0], tiny[1], range) || (planes && !cut(q[0][2] + q[0][3], q[1][2] + q[1][3], range)) ||
        (planes && !cut(q[0][3] - q[0][2], q[1][3] - q[1][2], range)) ||
        !cut(q[0][0] + margin * q[0][3], q[1][0] + margin * q[1][3], range) ||
        !cut(q[0][1] + margin * q[0][3], q[1][1] + margin * q[1][3], range) ||
        !cut(right * q[0][3] - q[0][0], right * q[1][3] - q[1][0], range) ||
        !cut(below * q[0][3] - q[0][1], below * q[1][3] - q[1][1], range))
        return false;
    for (int k = 0; k < 2; k++) {
        double t = range[k], w = q[0][3] + (q[1][3] - q[0][3]) * t;
        line->inverse_w[k] = 1 / w;
        for (int i = 0; i < 3; i++)
            line->over_w[k][i] = (p[0][i] + (p[1][i] - p[0][i]) * t) / w;
        line->x[k] = (q[0][0] + (q[1][0] - q[0][0]) * t) / w;
        line->y[k] = (q[0][1] + (q[1][1] - q[0][1]) * t) / w;
        line->whole[k] = t == (k ? 1 : 0);
    }
    double dx = line->x[1] - line->x[0], dy = line->y[1] - line->y[0];
    line->length = math_sqrt(dx * dx + dy * dy);
    line->style = style;
    line->half = edges->width[style] / 2;
    line->start = 0;
    line->reversed = false;
    return true;
}

// Sets all members of an edge's line except the points. Returns false if the edge is outside the picture.
static bool set_line(const struct edge_task *task, const struct mesh_edge *edge, int style, struct edge_line *line)
{
    double p[2][3];
    position(task, edge->corner, p[0]);
    position(task, edge_end(edge->corner), p[1]);
    if (!set_segment(task->view, p, style, line))
        return false;
    line->half = half_width(task, edge, line);
    return true;
}

bool edge_stroke_add(struct edge_strokes *strokes, struct edge_stroke stroke, struct call_control *call)
{
    if (strokes->count == strokes->capacity) {
        size_t capacity = strokes->capacity ? 2 * strokes->capacity : 1024;
        if (!call_charge(call, (capacity - strokes->capacity) * sizeof stroke))
            return false;
        struct edge_stroke *list = realloc(strokes->list, capacity * sizeof *list);
        if (!list) {
            call_refund(call, (capacity - strokes->capacity) * sizeof stroke);
            return false;
        }
        strokes->list = list;
        strokes->capacity = capacity;
    }
    strokes->list[strokes->count++] = stroke;
    return true;
}

// --- visible parts

static bool add_part(struct edge_task *task, const struct edge_line *line, double from, double to)
{
    struct edge_stroke stroke = {.half = line->half, .style = line->style};
    const double ends[2] = {from, to};
    for (int k = 0; k < 2; k++) {
        stroke.x[k] = line->x[0] + (line->x[1] - line->x[0]) * ends[k];
        stroke.y[k] = line->y[0] + (line->y[1] - line->y[0]) * ends[k];
        stroke.round[k] = line->whole[k] && ends[k] == k;
    }
    return edge_stroke_add(task->strokes, stroke, task->view->loop->call);
}

// Adds dashes of 5 widths and gaps of 3, measured along the chain of the line. A width below one pixel is treated as
// one pixel.
static bool add_dashes(struct edge_task *task, const struct edge_line *line, double from, double to)
{
    if (line->reversed) {
        double end = 1 - from;
        from = 1 - to;
        to = end;
    }
    double width = task->view->frame->edges.width[line->style], unit = width > 1 ? width : 1, period = 8 * unit;
    double first = line->start + from * line->length, last = line->start + to * line->length;
    for (int64_t n = (int64_t)(first / period); (double)n * period < last; n++) {
        double a = (double)n * period, b = a + 5 * unit;
        a = a > first ? a : first;
        b = b < last ? b : last;
        double x = a == first ? from : (a - line->start) / line->length,
               y = b == last ? to : (b - line->start) / line->length;
        if (a < b && !(line->reversed ? add_part(task, line, 1 - y, 1 - x) : add_part(task, line, x, y)))
            return false;
    }
    return true;
}

static bool add_run(struct edge_task *task, const struct edge_line *line, double from, double to, bool hidden)
{
    if (!hidden)
        return add_part(task, line, from, to);
    return line->style == EDGE_STYLE_GRID || task->view->frame->settings.hidden_lines != LAM_HIDDEN_LINES_DASH ||
           add_dashes(task, line, from, to);
}

// Bisects the intervals in which visibility changes, for all lines together.
static void narrow_changes(struct edge_task *task, struct scratch *s, uint32_t count)
{
    for (int round = 0; round < HALVINGS; round++) {
        for (uint32_t i = 0; i < count; i++)
            s->middles[i].share = 0.5 * (s->changes[i].from + s->changes[i].to);
        task->rays_of(task->view, s->lines, s->middles, count, s->middle_hidden);
        task->rays += count;
        for (uint32_t i = 0; i < count; i++) {
            if (s->middle_hidden[i] == s->changes[i].hidden)
                s->changes[i].from = s->middles[i].share;
            else
                s->changes[i].to = s->middles[i].share;
        }
    }
}

// Determines the visibility of the collected lines, and draws them.
static bool flush(struct edge_task *task, struct scratch *s)
{
    uint32_t changes = 0;
    if (s->point_count) {
        task->rays_of(task->view, s->lines, s->points, s->point_count, s->hidden);
        task->rays += s->point_count;
        for (uint32_t l = 0; l < s->line_count; l++) {
            const struct edge_line *line = &s->lines[l];
            for (uint32_t i = line->first; i + 1 < line->first + line->count; i++)
                if (s->hidden[i] != s->hidden[i + 1]) {
                    s->middles[changes].line = l;
                    s->changes[changes++] = (struct change){s->points[i].share, s->points[i + 1].share, s->hidden[i]};
                }
        }
        narrow_changes(task, s, changes);
    }
    bool ok = should_continue(task->view->loop);
    for (uint32_t l = 0, next = 0; l < s->line_count && ok; l++) {
        const struct edge_line *line = &s->lines[l];
        bool hidden = line->count && s->hidden[line->first];
        double from = 0;
        for (; next < changes && s->middles[next].line == l && ok; next++, hidden = !hidden) {
            double to = 0.5 * (s->changes[next].from + s->changes[next].to);
            ok = add_run(task, line, from, to, hidden);
            from = to;
        }
        ok = ok && add_run(task, line, from, 1, hidden);
    }
    s->line_count = s->point_count = 0;
    return ok;
}

// Adds the line that was set in s->lines[s->line_count], which is divided into intervals of about one pixel. Each
// interval is tested at its middle, unless hidden parts are drawn too.
static bool add_line(struct edge_task *task, struct scratch *s, bool shows_all)
{
    struct edge_line *line = &s->lines[s->line_count];
    line->first = s->point_count;
    line->count = shows_all                        ? 0
                  : line->length < 1               ? 1
                  : line->length < POINTS_PER_LINE ? (uint32_t)(line->length + 0.5)
                                                   : POINTS_PER_LINE;
    for (uint32_t i = 0; i < line->count; i++)
        s->points[s->point_count++] = (struct edge_point){s->line_count, (i + 0.5) / line->count};
    s->line_count++;
    bool full = s->point_count > POINTS - POINTS_PER_LINE || s->line_count == EDGES_PER_TASK;
    return !full || flush(task, s);
}

bool edge_task_segments(struct edge_task *task, const double (*segments)[2][3], int count, int style, void *memory)
{
    struct scratch *s = memory;
    s->line_count = s->point_count = 0;
    for (int i = 0; i < count; i++) {
        double p[2][3];
        for (int k = 0; k < 2; k++)
            ray_point(task->view->hierarchy, segments[i][k], p[k]);
        if (set_segment(task->view, p, style, &s->lines[s->line_count]) && !add_line(task, s, false))
            return false;
    }
    return flush(task, s);
}

bool edge_task_draw(struct edge_task *task, void *memory)
{
    struct scratch *s = memory;
    bool shows_all = task->view->frame->settings.hidden_lines == LAM_HIDDEN_LINES_SHOW;
    s->line_count = s->point_count = 0;
    for (uint32_t e = 0; e < task->count; e++) {
        struct edge_line *line = &s->lines[s->line_count];
        int style = drawn_style(task, e);
        if (style < 0 || !set_line(task, &task->edges[e], style, line))
            continue;
        task->drawn++;
        if (task->measures) {
            line->start = task->measures[e].start;
            line->reversed = task->measures[e].reversed;
        }
        if (!add_line(task, s, shows_all))
            return false;
    }
    return flush(task, s);
}

// Returns the height of a triangle relative to its longest edge, at most 1.
static double height_share(const struct edge_task *task, uint32_t triangle)
{
    double p[3][3], n[3], longest = 0;
    for (uint32_t k = 0; k < 3; k++)
        position(task, 3 * triangle + k, p[k]);
    for (int k = 0; k < 3; k++) {
        double side[3];
        for (int i = 0; i < 3; i++)
            side[i] = p[(k + 1) % 3][i] - p[k][i];
        double square = dot(side, side);
        longest = square > longest ? square : longest;
    }
    faces_eye(task, triangle, n);
    return longest > 0 ? math_sqrt(dot(n, n)) / longest : 0;
}

// A sliver is a triangle whose height is below 1/SLIVER of its longest edge. The narrower a sliver, the smaller the
// weight of a crease beside the sliver.
enum { SLIVER = 8 };

// Returns the weight of a line with these LAM_EDGES_… bits.
static uint16_t weight_of(const struct edge_task *task, const struct mesh_edge *edge, unsigned kinds,
                          const struct edge_line *line)
{
    double length = line->length;
    if (!line->whole[0] || !line->whole[1] || edge->kind & EDGE_CUT)
        return EDGE_WEIGHT_MAX;
    if (kinds == LAM_EDGES_CREASE && !(edge->kind & EDGE_SHARED)) {
        double a = height_over(task, edge->corner, line), b = height_over(task, edge->other, line);
        double c = height_share(task, edge->corner / 3), d = height_share(task, edge->other / 3);
        double height = a < b ? a : b, share = SLIVER * (c < d ? c : d);
        length *= (height < 1 ? height : 1) * (share < 1 ? share : 1);
    }
    return length < EDGE_WEIGHT_MAX / EDGE_WEIGHT_PIXEL ? (uint16_t)(length * EDGE_WEIGHT_PIXEL) : EDGE_WEIGHT_MAX;
}

void edge_task_weigh(struct edge_task *task)
{
    for (uint32_t e = 0; e < task->count; e++) {
        struct edge_line line;
        unsigned kinds;
        bool feature = style_of(task, &task->edges[e], &kinds) == EDGE_STYLE_FEATURE &&
                       set_line(task, &task->edges[e], EDGE_STYLE_FEATURE, &line);
        task->weights[e] = feature ? weight_of(task, &task->edges[e], kinds, &line) : EDGE_UNWEIGHED;
    }
}

void edge_task_ends(const struct edge_task *task, uint32_t edge, double ends[2][3])
{
    position(task, task->edges[edge].corner, ends[0]);
    position(task, edge_end(task->edges[edge].corner), ends[1]);
}

void edge_task_measure(struct edge_task *task)
{
    for (uint32_t e = 0; e < task->count; e++) {
        struct edge_measure *m = &task->measures[e];
        struct edge_line line;
        *m = (struct edge_measure){.style = drawn_style(task, e), .link = {NO_LINK, NO_LINK}};
        if (m->style >= 0 && !set_line(task, &task->edges[e], m->style, &line))
            m->style = -1;
        if (m->style < 0)
            continue;
        m->length = line.length;
        for (int k = 0; k < 2; k++) {
            m->x[k] = line.x[k];
            m->y[k] = line.y[k];
            m->whole[k] = line.whole[k];
        }
    }
}
