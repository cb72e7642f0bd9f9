// explain_figure.c: draws the figure of `explain -o`. The figure shows the vectors n, l, v, r and h as arrows on the
// surface, and the same vectors from the side. For threads, the figure shows t instead of r and h. Tables list the
// point's coordinates, the vectors, the angles and the terms.
#include "explain_figure.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "vectors.h"

enum { INK = 0x222222, GREY = 0x707070, RULE = 0xd8d8d8, WHITE = 0xffffff };
// the number of arrows, and the panel's size in units
enum { ARROWS = 6, PANEL = 500, PANEL_HEIGHT = 690, SIDE_HEIGHT = 190 };

// Colours that remain distinct for colour-blind readers (Okabe and Ito, https://jfly.uni-koeln.de/color/).
static const struct {
    const char *name, *meaning;
    uint32_t color;
} arrows[ARROWS] = {{"n", "normal", 0x0072b2},          {"l", "to the light", 0xc98a00},
                    {"v", "to the eye", 0x007a59},      {"r", "mirrored light", 0xb0558a},
                    {"h", "between l and v", 0xd55e00}, {"t", "tangent", 0x4d4dff}};

// The subject of the figure: the pixel's nearest surface, its shaded point, and the light that contributes most.
struct subject {
    const lam_explained_fragment *fragment; // NULL if there is only the background
    const lam_explained_point *point;
    const lam_explained_light *light; // NULL if no light contributes
    bool threads;                     // shaded by the tangent t (Kajiya-Kay), which does not use r and h
    lam_vec3 vectors[ARROWS];         // unit vectors; zero if a vector is missing or unused
};

struct sheet_layout {
    double unit; // the panel's unit; 1 for a picture 640 pixels high
    double left, right;
    double y; // the position of the next line
};

static double sum_of(lam_rgb c) { return (double)c.r + (double)c.g + (double)c.b; }

static struct subject find_subject(const lam_explanation *e)
{
    struct subject s = {0};
    if (!e->fragment_count)
        return s;
    s.fragment = &e->fragments[0];
    int corner = 0;
    for (int i = 1; i < s.fragment->point_count; i++)
        corner = s.fragment->weights[i] > s.fragment->weights[corner] ? i : corner;
    s.point = s.fragment->point_count ? &s.fragment->points[corner] : NULL;
    double most = 0;
    for (int i = 0; s.point && i < s.point->light_count; i++) {
        const lam_explained_light *l = &s.point->lights[i];
        double here = sum_of(l->diffuse_term) + sum_of(l->specular_term) + sum_of(l->ambient_term);
        if (here > most) {
            most = here;
            s.light = l;
        }
    }
    if (s.point) {
        s.vectors[0] = s.point->n;
        s.vectors[2] = s.point->v;
    }
    s.threads = s.point && !is_zero(s.point->t) && lam_reflection_describe(s.fragment->reflection)->tangents;
    if (s.threads)
        s.vectors[5] = s.point->t;
    if (s.light)
        s.vectors[1] = s.light->l;
    if (s.light && !s.threads) {
        s.vectors[3] = s.light->r;
        s.vectors[4] = s.light->h;
    }
    return s;
}

static double length_of(struct point p) { return __builtin_sqrt(p.x * p.x + p.y * p.y); }

// --- arrows

// The arrows at one point, and their letters.
struct diagram {
    struct point from, tips[ARROWS];
    bool has[ARROWS];
    double unit;
};

static struct point difference(struct point a, struct point b) { return (struct point){a.x - b.x, a.y - b.y}; }

// Returns whether an arrow is drawn very short, because its vector points almost towards the viewer.
static bool is_short(const struct diagram *g, int arrow)
{
    return length_of(difference(g->tips[arrow], g->from)) < 9 * g->unit;
}

// Returns the distance between a point and the arrow's line.
static double distance_of(struct point p, const struct diagram *g, int arrow)
{
    struct point way = difference(g->tips[arrow], g->from), to = difference(p, g->from);
    double square = way.x * way.x + way.y * way.y, along = square > 0 ? (to.x * way.x + to.y * way.y) / square : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return length_of((struct point){to.x - along * way.x, to.y - along * way.y});
}

// Finds a position for an arrow's letter around the arrow's tip, so that the letter does not overlap an arrow or an
// earlier letter. If every tried position overlaps, the result is the last tried position, at the largest distance from
// the tip.
static struct point find_place(const struct diagram *g, int arrow, const struct point *letters, int count)
{
    struct point way = difference(g->tips[arrow], g->from), at = g->tips[arrow];
    double length = length_of(way), size = 17 * g->unit;
    struct point along =
        is_short(g, arrow) ? (struct point){0.7071, 0.7071} : (struct point){way.x / length, way.y / length};
    for (int ring = 1; ring < 6; ring++)
        for (int turn = 0; turn < 3; turn++) {
            struct point side = turn == 0   ? along
                                : turn == 1 ? (struct point){-along.y, along.x}
                                            : (struct point){along.y, -along.x};
            double step = ((is_short(g, arrow) ? 14 : 6) + 9 * ring) * g->unit;
            at = (struct point){g->tips[arrow].x + side.x * step, g->tips[arrow].y + side.y * step};
            bool clear = true;
            for (int i = 0; i < ARROWS; i++)
                clear = clear && (!g->has[i] || distance_of(at, g, i) > 0.7 * size);
            for (int i = 0; i < count; i++)
                clear = clear && length_of(difference(at, letters[i])) > 1.2 * size;
            if (clear)
                return at;
        }
    return at;
}

static void draw_letters(const struct diagram *g, struct drawing *d)
{
    struct point letters[ARROWS];
    double size = 17 * g->unit;
    int count = 0;
    for (int i = 0; i < ARROWS; i++) {
        if (!g->has[i])
            continue;
        struct point at = find_place(g, i, letters, count);
        double width = text_width(d, size, arrows[i].name) + 6 * g->unit;
        letters[count++] = at;
        draw_box(d, (struct point){at.x - width / 2, at.y - 0.62 * size}, width, 1.24 * size, WHITE);
        draw_text(d, (struct point){at.x, at.y + 0.32 * size}, size, ALIGN_MIDDLE, arrows[i].color, arrows[i].name);
    }
}

// Draws an arrow over a wider white line that separates it from the picture. An arrow towards the viewer is a dot in a
// ring.
static bool draw_arrow(const struct diagram *g, int arrow, struct drawing *d, lam_error *error)
{
    struct point from = g->from, tip = g->tips[arrow], way = difference(tip, from);
    double length = length_of(way), unit = g->unit;
    uint32_t color = arrows[arrow].color;
    if (is_short(g, arrow))
        return draw_dot(d, from, 9.5 * unit, WHITE, error) && draw_dot(d, from, 8 * unit, color, error) &&
               draw_dot(d, from, 6 * unit, WHITE, error) && draw_dot(d, from, 3 * unit, color, error);
    struct point along = {way.x / length, way.y / length};
    double head = 11 * unit < length / 2 ? 11 * unit : length / 2, half = 0.42 * head;
    struct point line[2] = {from, tip}, neck = {tip.x - along.x * head, tip.y - along.y * head};
    struct point wings[3] = {
        {neck.x - along.y * half, neck.y + along.x * half}, tip, {neck.x + along.y * half, neck.y - along.x * half}};
    return draw_line(d, line, 2, 5.5 * unit, WHITE, 0, error) && draw_line(d, wings, 3, 5.5 * unit, WHITE, 0, error) &&
           draw_line(d, line, 2, 2.6 * unit, color, 0, error) && draw_line(d, wings, 3, 2.6 * unit, color, 0, error);
}

// Draws the arrows in an order in which no arrow hides another. In the picture, the arrow h covers the beginning of the
// arrow l, so h is drawn after l. Then n is drawn, and vectors towards the viewer are drawn last.
static bool draw_diagram(const struct diagram *g, struct drawing *d, lam_error *error)
{
    static const int order[ARROWS] = {2, 3, 5, 1, 4, 0};
    bool spot = draw_dot(d, g->from, 3.5 * g->unit, WHITE, error);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; spot && i < ARROWS; i++)
            if (g->has[order[i]] && is_short(g, order[i]) == (pass == 1))
                spot = draw_arrow(g, order[i], d, error);
    draw_letters(g, d);
    return spot;
}

// Computes the positions of the arrows' tips in the picture. Each arrow starts at the shaded point and has the length
// `length` in the scene. Returns false if a tip is outside the picture.
static bool find_tips(const struct explain_figure *f, const struct subject *s, double length, double margin,
                      struct point tips[ARROWS])
{
    bool inside = true;
    for (int i = 0; i < ARROWS; i++) {
        lam_vec3 from = s->point->position, v = s->vectors[i];
        lam_vec3 to = {from.x + length * v.x, from.y + length * v.y, from.z + length * v.z};
        int width = f->explanation->width, height = f->explanation->height;
        if (is_zero(v))
            continue;
        inside = lam_camera_project(f->camera, width, height, to, &tips[i].x, &tips[i].y) && inside;
        inside = inside && tips[i].x > margin && tips[i].y > margin && tips[i].x < width - margin &&
                 tips[i].y < height - margin;
    }
    return inside;
}

// Draws the arrows on the picture, with a dot at the point. The arrows are shortened until all of them fit.
static bool draw_vectors(const struct explain_figure *f, const struct subject *s, struct point corner, double unit,
                         struct drawing *d, lam_error *error)
{
    const lam_explanation *e = f->explanation;
    struct point from, tips[ARROWS] = {{0, 0}}, beside;
    lam_vec3 p = s->point->position;
    if (!lam_camera_project(f->camera, e->width, e->height, p, &from.x, &from.y) ||
        !lam_camera_project(f->camera, e->width, e->height, (lam_vec3){p.x + 1, p.y, p.z}, &beside.x, &beside.y))
        return true;
    double shorter = e->width < e->height ? e->width : e->height, length = 0.34 * shorter / (beside.x - from.x);
    if (!(f->camera->ortho_half_height > 0) && length > -0.5 * p.z)
        length = -0.5 * p.z;
    double least = length / 4;
    while (!find_tips(f, s, length, 24 * unit, tips) && length > least)
        length *= 0.92;
    struct diagram g = {.from = {corner.x + from.x, corner.y + from.y}, .unit = unit};
    for (int i = 0; i < ARROWS; i++) {
        g.has[i] = !is_zero(s->vectors[i]);
        g.tips[i] = (struct point){corner.x + tips[i].x, corner.y + tips[i].y};
    }
    return draw_diagram(&g, d, error);
}

// Draws the vectors from the side: in the plane of n and l (or of n and v, if there is no light). The surface is a
// horizontal line. For a thread, only the angle between t and l matters, so the plane contains t and l. The horizontal
// line is then the thread.
static bool draw_from_the_side(const struct subject *s, const struct sheet_layout *at, struct drawing *d,
                               lam_error *error)
{
    double u = at->unit, length = 118 * u;
    struct point foot = {(at->left + at->right) / 2, at->y + 148 * u};
    lam_vec3 n = s->vectors[0], other = is_zero(s->vectors[1]) ? s->vectors[2] : s->vectors[1];
    if (s->threads) {
        double along = dot(other, s->point->t);
        lam_vec3 t = s->point->t, across = {other.x - along * t.x, other.y - along * t.y, other.z - along * t.z};
        double length_across = __builtin_sqrt(dot(across, across));
        if (length_across > 1e-4)
            n = (lam_vec3){across.x / length_across, across.y / length_across, across.z / length_across};
        other = t;
    }
    double up = dot(other, n);
    lam_vec3 level = {other.x - up * n.x, other.y - up * n.y, other.z - up * n.z};
    double size = __builtin_sqrt(dot(level, level));
    if (!(size > 1e-4)) { // the vector is parallel to the normal, so any direction along the surface is suitable
        level = n.x * n.x < 0.5 ? (lam_vec3){0, n.z, -n.y} : (lam_vec3){-n.z, 0, n.x};
        size = __builtin_sqrt(dot(level, level));
    }
    struct point ground[2] = {{foot.x - 190 * u, foot.y}, {foot.x + 190 * u, foot.y}};
    struct diagram g = {.from = foot, .unit = u};
    for (int i = 0; i < ARROWS; i++) {
        lam_vec3 v = s->vectors[i];
        g.has[i] = !is_zero(v);
        g.tips[i] = (struct point){foot.x - length * dot(v, level) / size, foot.y - length * dot(v, n)};
    }
    return draw_line(d, ground, 2, 2 * u, GREY, 0, error) && draw_diagram(&g, d, error);
}

// --- tables

static bool draw_rule(struct drawing *d, const struct sheet_layout *at, double y, lam_error *error)
{
    struct point line[2] = {{at->left, y}, {at->right, y}};
    return draw_line(d, line, 2, at->unit, RULE, 0, error);
}

static void put(struct drawing *d, const struct sheet_layout *at, double x, enum align align, uint32_t color,
                const char *text)
{
    draw_text(d, (struct point){at->left + x * at->unit, at->y}, 12.5 * at->unit, align, color, text);
}

// Prints a table's heading and the names of its columns.
static bool begin_table(struct drawing *d, struct sheet_layout *at, const char *title, const char *const *columns,
                        lam_error *error)
{
    at->y += 25 * at->unit;
    put(d, at, 0, ALIGN_LEFT, INK, title);
    for (int i = 0; columns[i]; i++)
        put(d, at, 186 + 98 * i, ALIGN_RIGHT, GREY, columns[i]);
    bool ok = draw_rule(d, at, at->y + 5 * at->unit, error);
    at->y += 3 * at->unit;
    return ok;
}

static void put_row(struct drawing *d, struct sheet_layout *at, uint32_t color, const char *name, const double *numbers,
                    int count)
{
    char text[40];
    at->y += 18 * at->unit;
    put(d, at, 0, ALIGN_LEFT, color, name);
    for (int i = 0; i < count; i++) {
        double x = numbers[i] + 0.0;
        snprintf(text, sizeof text, "%.5g", x > -5e-13 && x < 5e-13 ? 0.0 : x);
        put(d, at, 186 + 98 * i, ALIGN_RIGHT, INK, x - x == 0 ? text : "–");
    }
}

static void put_color(struct drawing *d, struct sheet_layout *at, const char *name, lam_rgb c)
{
    put_row(d, at, GREY, name, (double[3]){(double)c.r, (double)c.g, (double)c.b}, 3);
}

static void put_vector(struct drawing *d, struct sheet_layout *at, uint32_t color, const char *name, lam_vec3 v)
{
    put_row(d, at, color, name, (double[3]){v.x, v.y, v.z}, 3);
}

// Prints the point's coordinates in each space, from the mesh to the window.
static bool put_places(const lam_explained_fragment *f, struct drawing *d, struct sheet_layout *at, lam_error *error)
{
    static const char *const columns[] = {"x", "y", "z", "w", NULL};
    const lam_explained_place *p = f->places ? &f->places[3] : NULL;
    if (!p)
        return true;
    if (!begin_table(d, at, "The point", columns, error))
        return false;
    put_vector(d, at, GREY, "object", p->mesh_position);
    put_vector(d, at, GREY, "eye", p->eye_position);
    put_row(d, at, GREY, "clip", p->clip, 4);
    put_row(d, at, GREY, "NDC", p->ndc, 3);
    put_row(d, at, GREY, "window", p->window, 3);
    char text[100];
    if (f->winding - f->winding != 0)
        return true;
    at->y += 18 * at->unit;
    put(d, at, 0, ALIGN_LEFT, GREY, "winding");
    snprintf(text, sizeof text, "%s, the %s; 2 · area = %.5g pixels",
             f->winding > 0 ? "counter-clockwise" : "clockwise", f->back ? "back" : "front", f->winding);
    put(d, at, 100, ALIGN_LEFT, INK, text);
    return true;
}

static bool put_vectors(const struct subject *s, struct drawing *d, struct sheet_layout *at, lam_error *error)
{
    static const char *const columns[] = {"x", "y", "z", NULL};
    if (!begin_table(d, at, "Vectors in eye space", columns, error))
        return false;
    for (int i = 0; i < ARROWS; i++) {
        char name[48];
        snprintf(name, sizeof name, "%s", arrows[i].name);
        if (is_zero(s->vectors[i]))
            continue;
        put_vector(d, at, arrows[i].color, name, s->vectors[i]);
        put(d, at, 400, ALIGN_LEFT, GREY, arrows[i].meaning);
    }
    if (!s->light)
        return true;
    char text[160];
    double angles[3] = {in_degrees(s->light->theta_rad), in_degrees(s->light->phi_rad), in_degrees(s->light->psi_rad)};
    static const char *const names[3] = {"θ(n, l)", "φ(r, v)", "ψ(n, h)"};
    text[0] = 0;
    if (s->threads)
        snprintf(text, sizeof text, "cos(t, l) = %.5g, cos(t, v) = %.5g", dot(s->point->t, s->light->l),
                 dot(s->point->t, s->point->v));
    for (int i = 0; !s->threads && i < 3; i++)
        if (angles[i] - angles[i] == 0)
            snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s = %.4g°", *text ? ", " : "", names[i],
                     angles[i]);
    at->y += 20 * at->unit;
    put(d, at, 0, ALIGN_LEFT, INK, text);
    return true;
}

// Prints the factors of the drawn light and the terms of the sum.
static bool put_terms(const lam_explanation *e, const struct subject *s, struct drawing *d, struct sheet_layout *at,
                      lam_error *error)
{
    static const char *const columns[] = {"red", "green", "blue", NULL};
    const lam_explained_point *p = s->point;
    if (!begin_table(d, at, p->corner >= 0 ? "Terms at the corner" : "Terms", columns, error))
        return false;
    if (sum_of(p->emission) != 0)
        put_color(d, at, "emission", p->emission);
    put_color(d, at, "ambient", p->ambient);
    put_color(d, at, "diffuse", p->diffuse);
    put_color(d, at, "specular", p->specular);
    if (e->has_environment)
        put_color(d, at, "reflection", p->reflection);
    put_color(d, at, "sum", p->sum);
    char text[160];
    if (s->light) {
        at->y += 20 * at->unit;
        snprintf(text, sizeof text, "light: n·l = %.4g, attenuation %.4g, spot %.4g, D = %.4g, S = %.4g",
                 (double)s->light->n_dot_l, (double)s->light->attenuation, (double)s->light->spot, (double)s->light->D,
                 (double)s->light->S);
        put(d, at, 0, ALIGN_LEFT, INK, text);
    }
    at->y += 18 * at->unit;
    snprintf(text, sizeof text, "the pixel: %u %u %u, alpha %u", e->bytes[0], e->bytes[1], e->bytes[2], e->bytes[3]);
    put(d, at, 0, ALIGN_LEFT, INK, text);
    return true;
}

// Prints the heading of the panel: the surface, the methods, and the light for which the arrows are drawn.
static void put_words(const struct explain_figure *f, const struct subject *s, struct drawing *d,
                      struct sheet_layout *at)
{
    const lam_explanation *e = f->explanation;
    char text[200];
    if (!s->fragment) {
        put(d, at, 0, ALIGN_LEFT, INK, "Only the background is visible here.");
        return;
    }
    const char *item = s->fragment->corners == 3 ? "triangle" : s->fragment->corners == 2 ? "line" : "point";
    snprintf(text, sizeof text, "%s %u%s%.60s, %s shading, %s reflection", item, s->fragment->triangle,
             s->fragment->object_name ? " of " : "", s->fragment->object_name ? s->fragment->object_name : "",
             e->shading == LAM_SHADING_PHONG     ? "Phong"
             : e->shading == LAM_SHADING_GOURAUD ? "Gouraud"
                                                 : "flat",
             lam_reflection_describe(s->fragment->reflection)->word);
    put(d, at, 0, ALIGN_LEFT, INK, text);
    at->y += 18 * at->unit;
    if (!s->point)
        return;
    int adding = 0;
    for (int i = 0; i < s->point->light_count; i++)
        adding += sum_of(s->point->lights[i].diffuse_term) + sum_of(s->point->lights[i].specular_term) > 0;
    const char *name = s->light ? s->light->name : NULL;
    if (!s->light)
        snprintf(text, sizeof text, "no light adds anything here");
    else
        snprintf(text, sizeof text, "%s: %s light%s%.60s%s%s", s->threads ? "l" : "l, r and h",
                 lam_light_type_describe(s->light->type)->word, name ? " '" : "", name ? name : "", name ? "'" : "",
                 adding > 1 ? ", the strongest here" : "");
    if (s->point->corner >= 0)
        snprintf(text + strlen(text), sizeof text - strlen(text), "; at corner %d, which is lit", s->point->corner);
    put(d, at, 0, ALIGN_LEFT, GREY, text);
}

// --- the page

static double unit_of(const lam_explanation *e)
{
    double shorter = e->width < e->height ? e->width : e->height, unit = shorter / 640;
    return unit > 0.75 ? unit : 0.75;
}

static double head_of(double unit) { return 52 * unit; }

void explain_figure_size(const struct explain_figure *f, int *width, int *height)
{
    const lam_explanation *e = f->explanation;
    double unit = unit_of(e), rows = PANEL_HEIGHT * unit;
    *width = e->width + (int)((PANEL + 72) * unit);
    *height = (int)(head_of(unit) + (rows > e->height ? rows : e->height) + 24 * unit);
}

// Describes the figure in words for readers who cannot see it.
static bool describe(const struct explain_figure *f, const struct subject *s, const char *title, struct drawing *d,
                     lam_error *error)
{
    const lam_explanation *e = f->explanation;
    char text[700];
    int used = snprintf(text, sizeof text, "A picture of %d by %d pixels; the pixel %d,%d is explained.", e->width,
                        e->height, e->x, e->y);
    if (!s->point)
        return drawing_describe(d, title, text, error);
    lam_vec3 n = s->vectors[0], v = s->vectors[2], l = s->vectors[1];
    used +=
        snprintf(text + used, sizeof text - (size_t)used,
                 " In eye space the normal n is (%.3g, %.3g, %.3g), the direction to the eye v is (%.3g, %.3g, %.3g)",
                 n.x, n.y, n.z, v.x, v.y, v.z);
    if (s->light)
        used += snprintf(text + used, sizeof text - (size_t)used,
                         ", and the direction to the light l is (%.3g, %.3g, %.3g)", l.x, l.y, l.z);
    if (s->threads)
        used +=
            snprintf(text + used, sizeof text - (size_t)used, ", and the tangent t of the thread is (%.3g, %.3g, %.3g)",
                     s->vectors[5].x, s->vectors[5].y, s->vectors[5].z);
    lam_rgb sum = s->point->sum;
    snprintf(text + used, sizeof text - (size_t)used,
             ". The terms' sum is (%.3g, %.3g, %.3g), and the pixel is %u %u %u with alpha %u.", (double)sum.r,
             (double)sum.g, (double)sum.b, e->bytes[0], e->bytes[1], e->bytes[2], e->bytes[3]);
    return drawing_describe(d, title, text, error);
}

// Draws a ring around the pixel if nothing is shaded.
static bool draw_ring(struct drawing *d, struct point middle, double unit, lam_error *error)
{
    struct point round[33];
    for (int i = 0; i <= 32; i++) { // a circle with 32 sides
        static const double quarter[9] = {0, 0.1951, 0.3827, 0.5556, 0.7071, 0.8315, 0.9239, 0.9808, 1};
        int part = i % 32, side = part / 8, step = part % 8;
        double a = quarter[8 - step], b = quarter[step];
        double x = side == 0   ? a
                   : side == 1 ? -b
                   : side == 2 ? -a
                               : b,
               y = side == 0   ? b
                   : side == 1 ? a
                   : side == 2 ? -b
                               : -a;
        round[i] = (struct point){middle.x + 9 * unit * x, middle.y + 9 * unit * y};
    }
    return draw_line(d, round, 33, 2 * unit, arrows[4].color, 0, error);
}

bool explain_figure_draw(const struct explain_figure *f, struct drawing *d, lam_error *error)
{
    const lam_explanation *e = f->explanation;
    struct subject s = find_subject(e);
    double unit = unit_of(e);
    char title[256];
    const char *slash = strrchr(f->model, '/');
    snprintf(title, sizeof title, "%.180s, pixel %d,%d", slash && slash[1] ? slash + 1 : f->model, e->x, e->y);
    const char *words = f->title ? f->title : title;
    struct point corner = {24 * unit, head_of(unit)};
    struct sheet_layout at = {.unit = unit, .left = corner.x + e->width + 28 * unit, .y = head_of(unit) + 10 * unit};
    at.right = at.left + (PANEL - 4) * unit;
    if (!describe(f, &s, words, d, error))
        return false;
    draw_text(d, (struct point){corner.x, 34 * unit}, 20 * unit, ALIGN_LEFT, INK, words);
    if (!draw_image(d, f->picture, (int)corner.x, (int)corner.y, words, error))
        return false;
    put_words(f, &s, d, &at);
    if (!s.point)
        return draw_ring(d, (struct point){(int)corner.x + e->x + 0.5, (int)corner.y + e->y + 0.5}, unit, error);
    at.y += 8 * unit;
    corner = (struct point){(int)corner.x, (int)corner.y};
    bool ok = draw_vectors(f, &s, corner, unit, d, error) && draw_from_the_side(&s, &at, d, error);
    at.y += SIDE_HEIGHT * unit;
    return ok && put_places(s.fragment, d, &at, error) && put_vectors(&s, d, &at, error) &&
           put_terms(e, &s, d, &at, error);
}
