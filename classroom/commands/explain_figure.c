// explain_figure.c: draws the figure of `explain -o`. The figure shows the vectors n, l, v, r and h as arrows on the
// surface, and below it the same vectors from the side. For threads, the figure shows t instead of r and h. Tables list the
// point's coordinates, the vectors, the angles and the terms.
//
// The file is longer than 600 lines, because all panels of the figure share its layout and the members of the explanation.
#include "commands.h"

#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/camera.h>

#include "child.h"
#include "console.h"
#include "drawing.h"
#include "footprint.h"
#include "run.h"
#include "sandbox_start.h"
#include "vectors.h"

enum { INK = 0x222222, GREY = 0x707070, RULE = 0xd8d8d8, WHITE = 0xffffff };
// the number of arrows, and the panel's size in units
enum { ARROWS = 6, PANEL = 500, PANEL_HEIGHT = 810, SIDE_HEIGHT = 190, SIDE_MAX = 65535 };

// Colours that remain distinct for colour-blind readers (Okabe and Ito, https://jfly.uni-koeln.de/color/).
static const struct {
    const char *name, *meaning;
    uint32_t color;
} arrows[ARROWS] = {{"n", "normal", 0x0072b2},          {"l", "to the light", 0xc98a00},
                    {"v", "to the eye", 0x007a59},      {"r", "mirrored light", 0xb0558a},
                    {"h", "between l and v", 0xd55e00}, {"t", "tangent", 0x4d4dff}};

struct figure {
    const json_t *explanation; // the line of `lambent explain --json`
    int x, y, width, height;   // the explained pixel, and the size of the picture
    lam_camera camera;         // the camera that rendered the picture; only its projection is set
    lam_image picture;
    int figure; // enum figure_name
};

// The subject of the figure: the pixel's nearest surface, its shaded point, and the light that contributes most.
struct subject {
    const json_t *fragment;   // NULL if there is only the background
    const json_t *point;      // NULL if nothing is shaded
    const json_t *light;      // NULL if no light contributes
    bool threads;             // shaded by the tangent t (Kajiya-Kay), which does not use r and h
    lam_vec3 vectors[ARROWS]; // unit vectors; zero if a vector is missing or unused
};

struct sheet_layout {
    double unit; // the panel's unit; 1 for a picture 640 pixels high
    double left, right;
    double y; // the position of the next line
};

// --- the members of the explanation

static const json_t *member(const json_t *o, const char *key) { return json_object_get(o, key); }
static const json_t *element(const json_t *list, size_t i) { return json_array_get(list, i); }

// Returns a number, or NaN if it is missing.
static double number_of(const json_t *number)
{
    return json_is_number(number) ? json_number_value(number) : (double)NAN;
}
static double number(const json_t *o, const char *key) { return number_of(member(o, key)); }
static int whole(const json_t *o, const char *key) { return (int)json_integer_value(member(o, key)); }
static const char *text_of(const json_t *o, const char *key) { return json_string_value(member(o, key)); }

// Returns a vector or a colour; zero if it is missing.
static lam_vec3 vector(const json_t *o, const char *key)
{
    const json_t *list = member(o, key);
    return (lam_vec3){json_number_value(element(list, 0)), json_number_value(element(list, 1)),
                      json_number_value(element(list, 2))};
}

static double sum_of(const json_t *o, const char *key)
{
    lam_vec3 c = vector(o, key);
    return c.x + c.y + c.z;
}

static struct subject find_subject(const struct figure *f)
{
    struct subject s = {.fragment = element(member(f->explanation, "triangles"), 0)};
    const json_t *points = member(s.fragment, "points"), *weights = member(s.fragment, "weights");
    size_t corner = 0;
    for (size_t i = 1; i < json_array_size(points); i++)
        corner = number_of(element(weights, i)) > number_of(element(weights, corner)) ? i : corner;
    s.point = element(points, corner);
    double most = 0;
    const json_t *lights = member(s.point, "lights");
    for (size_t i = 0; i < json_array_size(lights); i++) {
        const json_t *l = element(lights, i);
        double here = sum_of(l, "diffuse_term") + sum_of(l, "specular_term") + sum_of(l, "ambient_term");
        if (here > most) {
            most = here;
            s.light = l;
        }
    }
    s.vectors[0] = vector(s.point, "n");
    s.vectors[2] = vector(s.point, "v");
    s.threads = json_is_true(member(member(s.fragment, "formulas"), "threads")) && !is_zero(vector(s.point, "t"));
    if (s.threads)
        s.vectors[5] = vector(s.point, "t");
    s.vectors[1] = vector(s.light, "l");
    if (!s.threads) {
        s.vectors[3] = vector(s.light, "r");
        s.vectors[4] = vector(s.light, "h");
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
static bool find_tips(const struct figure *f, const struct subject *s, double length, double margin,
                      struct point tips[ARROWS])
{
    bool inside = true;
    for (int i = 0; i < ARROWS; i++) {
        lam_vec3 from = vector(s->point, "position"), v = s->vectors[i];
        lam_vec3 to = {from.x + length * v.x, from.y + length * v.y, from.z + length * v.z};
        if (is_zero(v))
            continue;
        inside = lam_camera_project(&f->camera, f->width, f->height, to, &tips[i].x, &tips[i].y) && inside;
        inside = inside && tips[i].x > margin && tips[i].y > margin && tips[i].x < f->width - margin &&
                 tips[i].y < f->height - margin;
    }
    return inside;
}

// Draws the arrows on the picture, with a dot at the point. The arrows are shortened until all of them fit.
static bool draw_vectors(const struct figure *f, const struct subject *s, struct point corner, double unit,
                         struct drawing *d, lam_error *error)
{
    struct point from, tips[ARROWS] = {{0, 0}}, beside;
    lam_vec3 p = vector(s->point, "position");
    if (!lam_camera_project(&f->camera, f->width, f->height, p, &from.x, &from.y) ||
        !lam_camera_project(&f->camera, f->width, f->height, (lam_vec3){p.x + 1, p.y, p.z}, &beside.x, &beside.y))
        return true;
    double shorter = f->width < f->height ? f->width : f->height, length = 0.34 * shorter / (beside.x - from.x);
    if (!(f->camera.ortho_half_height > 0) && length > -0.5 * p.z)
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
        lam_vec3 t = s->vectors[5];
        double along = dot(other, t);
        lam_vec3 across = {other.x - along * t.x, other.y - along * t.y, other.z - along * t.z};
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

// Draws Lambert's law below the picture: a beam of the light with the width 1, and the area 1/cos θ that it covers.
static bool draw_law(const struct subject *s, const struct sheet_layout *at, struct drawing *d, lam_error *error)
{
    const double u = at->unit, cosine = dot(s->vectors[0], s->vectors[1]), sine = __builtin_sqrt(1 - cosine * cosine);
    const struct point foot = {(at->left + at->right) / 2, at->y + 148 * u};
    struct diagram g = {.from = foot, .has = {true, true}, .unit = u};
    g.tips[0] = (struct point){foot.x, foot.y - 118 * u};
    g.tips[1] = (struct point){foot.x - 118 * u * sine, foot.y - 118 * u * cosine};
    return draw_beam(d, foot, u, cosine, arrows[1].color, error) && draw_diagram(&g, d, error);
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
        snprintf(text, sizeof text, "%.6g", x > -5e-13 && x < 5e-13 ? 0.0 : x);
        put(d, at, 186 + 98 * i, ALIGN_RIGHT, INK, x - x == 0 ? text : "–");
    }
}

static void put_vector(struct drawing *d, struct sheet_layout *at, uint32_t color, const char *name, lam_vec3 v)
{
    put_row(d, at, color, name, (double[3]){v.x, v.y, v.z}, 3);
}

// Prints a line of names and numbers with a unit: "D = 0.5, S = 0.1". Omits missing numbers.
static void put_numbers(struct drawing *d, struct sheet_layout *at, const char *const *names, const double *numbers,
                        const char *unit)
{
    char text[200] = "";
    for (int i = 0; names[i]; i++)
        if (numbers[i] - numbers[i] == 0) {
            size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s = %.6g%s", used ? ", " : "", names[i], numbers[i] + 0.0,
                     unit);
        }
    at->y += 20 * at->unit;
    put(d, at, 0, ALIGN_LEFT, INK, text);
}

// Prints the numbers of a member of an object.
static void put_member(struct drawing *d, struct sheet_layout *at, const char *name, const json_t *o, const char *key)
{
    double numbers[4] = {0};
    const json_t *list = member(o, key);
    int count = json_array_size(list) < 4 ? (int)json_array_size(list) : 4;
    for (int i = 0; i < count; i++)
        numbers[i] = number_of(element(list, (size_t)i));
    put_row(d, at, GREY, name, numbers, count);
}

// Prints the point's coordinates in each space, from the mesh to the window.
static bool put_places(const json_t *fragment, struct drawing *d, struct sheet_layout *at, lam_error *error)
{
    static const char *const columns[] = {"x", "y", "z", "w", NULL};
    const json_t *p = element(member(fragment, "places"), 3);
    if (!p)
        return true;
    if (!begin_table(d, at, "The point", columns, error))
        return false;
    put_member(d, at, "object", p, "object");
    put_member(d, at, "eye", p, "eye");
    put_member(d, at, "clip", p, "clip");
    put_member(d, at, "NDC", p, "ndc");
    put_member(d, at, "window", p, "window");
    char text[100];
    double winding = number(fragment, "winding");
    if (winding - winding != 0)
        return true;
    at->y += 18 * at->unit;
    put(d, at, 0, ALIGN_LEFT, GREY, "winding");
    snprintf(text, sizeof text, "%s, the %s; 2 · area = %.5g pixels", winding > 0 ? "counter-clockwise" : "clockwise",
             text_of(fragment, "side"), winding);
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
    if (s->threads) {
        put_numbers(d, at, (const char *[]){"cos(t, l)", "cos(t, v)", NULL},
                    (double[]){dot(s->vectors[5], s->vectors[1]), dot(s->vectors[5], s->vectors[2])}, "");
        return true;
    }
    put_numbers(d, at, (const char *[]){"θ(n, l)", "φ(r, v)", "ψ(n, h)", NULL},
                (double[]){number(s->light, "theta_deg"), number(s->light, "phi_deg"), number(s->light, "psi_deg")},
                "°");
    char text[100];
    const double off = number(s->light, "v_off_plane_deg");
    if (off > 0.05) {
        snprintf(text, sizeof text, "φ is not 2ψ, because v is %.2f° off the plane of n and l", off);
        at->y += 18 * at->unit;
        put(d, at, 0, ALIGN_LEFT, GREY, text);
    }
    return true;
}

static const char *const channels[] = {"red", "green", "blue", NULL};

// Prints the factors of the drawn light.
static bool put_light(const json_t *l, struct drawing *d, struct sheet_layout *at, lam_error *error)
{
    if (!l)
        return true;
    if (!begin_table(d, at, "The light's factors", channels, error))
        return false;
    put_member(d, at, "kd Ld", l, "kd_Ld");
    put_member(d, at, "ks Ls", l, "ks_Ls");
    if (json_is_true(member(l, "casts_shadows")))
        put_member(d, at, "passed", l, "passed");
    double occlusion = number(l, "occlusion");
    put_numbers(d, at, (const char *[]){"n·l", "attenuation", "spot", "occlusion", NULL},
                (double[]){number(l, "n_dot_l"), number(l, "attenuation"), number(l, "spot"),
                           occlusion != 1 ? occlusion : (double)NAN},
                "");
    put_numbers(d, at, (const char *[]){"D", "S = base^α", "base", "α", NULL},
                (double[]){number(l, "D"), number(l, "S"), number(l, "base"), number(l, "power")}, "");
    return true;
}

// Prints the terms of the sum. The diffuse and specular terms belong to the drawn light; the other lights and the
// environment are one row.
static bool put_terms(const struct subject *s, struct drawing *d, struct sheet_layout *at, lam_error *error)
{
    const json_t *terms = member(s->point, "terms"), *color = member(s->point, "color");
    if (!begin_table(d, at, json_is_integer(member(s->point, "corner")) ? "Terms at the corner" : "Terms", channels,
                     error))
        return false;
    double diffuse[3], specular[3], others[3], most = 0;
    for (size_t i = 0; i < 3; i++) {
        diffuse[i] =
            s->light ? number_of(element(color, i)) * number_of(element(member(s->light, "diffuse_term"), i)) : 0;
        specular[i] = s->light ? number_of(element(member(s->light, "specular_term"), i)) : 0;
        others[i] = number_of(element(member(terms, "diffuse"), i)) + number_of(element(member(terms, "specular"), i)) -
                    diffuse[i] - specular[i];
        most = fabs(others[i]) > most ? fabs(others[i]) : most;
    }
    if (sum_of(terms, "emission") != 0)
        put_member(d, at, "emission", terms, "emission");
    put_member(d, at, "ambient", terms, "ambient");
    if (sum_of(s->point, "color") != 3)
        put_member(d, at, "surface colour", s->point, "color");
    put_row(d, at, GREY, "diffuse", diffuse, 3);
    put_row(d, at, GREY, "specular", specular, 3);
    if (most > 1e-7)
        put_row(d, at, GREY, "other lights", others, 3);
    if (json_is_object(member(s->point, "environment")))
        put_member(d, at, "reflection", terms, "reflection");
    put_member(d, at, "sum", s->point, "sum");
    return true;
}

// Prints a row of colours, with a remark.
static void put_step(struct drawing *d, struct sheet_layout *at, const char *name, const double *color,
                     const char *remark)
{
    put_row(d, at, GREY, name, color, 3);
    put(d, at, 400, ALIGN_LEFT, GREY, remark);
}

static void numbers_of(const json_t *o, const char *key, double numbers[4])
{
    for (size_t i = 0; i < 4; i++)
        numbers[i] = number_of(element(member(o, key), i));
}

// Prints every step from the sum to the bytes: other triangles, exposure, background, alpha, tone curve, encoding and
// rounding. Omits the steps that change nothing.
static bool put_steps(const json_t *e, const struct subject *s, struct drawing *d, struct sheet_layout *at,
                      lam_error *error)
{
    if (!begin_table(d, at, "From sum to bytes", channels, error))
        return false;
    double color[4], sum[4], others[4], back[4], shown[4];
    numbers_of(s->fragment, "color", color);
    numbers_of(e, "sum", sum);
    numbers_of(e, "background", back);
    const double share = number(s->fragment, "weight") * color[3], exposure = number(e, "exposure");
    for (int i = 0; i < 4; i++)
        others[i] = sum[i] - share * (i < 3 ? color[i] : 1);
    char text[48];
    if (json_array_size(member(s->fragment, "points")) > 1)
        put_step(d, at, "interpolated", color, "Σ weight · corner");
    if (share != 1) {
        snprintf(text, sizeof text, "%.6g · colour", share);
        for (int i = 0; i < 3; i++)
            color[i] *= share;
        put_step(d, at, text, color, "covered share");
        put_step(d, at, "+ others", others, "other triangles");
    }
    if (exposure != 1) {
        snprintf(text, sizeof text, "· %.6g", exposure);
        put_step(d, at, text, (double[]){sum[0] * exposure, sum[1] * exposure, sum[2] * exposure}, "exposure");
    }
    if (sum[3] != 1) {
        snprintf(text, sizeof text, "÷ %.6g", sum[3]);
        numbers_of(e, "exposed", shown);
        put_step(d, at, text, shown, "alpha");
    }
    static const struct {
        const char *key, *name, *choice;
        int count;
    } last[] = {{"curved", "toned: ", "tone", 3}, {"encoded", "encoded: ", "encoding", 3}, {"bytes", "bytes", NULL, 4}};
    for (int i = strcmp(text_of(e, "tone"), "none") == 0; i < 3; i++) {
        if (i == 1 && back[3] > 0 && sum[3] < 1) { // the background does not pass the tone curve
            put_step(d, at, "background", back, "");
            numbers_of(e, "toned", shown);
            put_row(d, at, GREY, "over it", shown, 3);
            double all = sum[3] + (1 - sum[3]) * back[3];
            snprintf(text, sizeof text, "%.6g · x + %.6g · background", sum[3] / all, (1 - sum[3]) * back[3] / all);
            at->y += 18 * at->unit;
            put(d, at, 12, ALIGN_LEFT, GREY, text);
        }
        numbers_of(e, last[i].key, shown);
        snprintf(text, sizeof text, "%s%.30s", last[i].name, last[i].choice ? text_of(e, last[i].choice) : "");
        put_row(d, at, GREY, text, shown, last[i].count);
        at->y += 18 * at->unit;
        put(d, at, 12, ALIGN_LEFT, GREY, text_of(member(e, "formulas"), last[i].key));
    }
    return true;
}

// Prints the heading of the panel: the surface, the methods, and the light for which the arrows are drawn.
static void put_words(const json_t *e, const struct subject *s, struct drawing *d, struct sheet_layout *at)
{
    char text[200];
    if (!s->fragment) {
        put(d, at, 0, ALIGN_LEFT, INK, "Only the background is visible here.");
        return;
    }
    static const char *const items[] = {"triangle", "line", "point"};
    const char *object = text_of(s->fragment, "object_name"), *shading = text_of(e, "shading");
    int item = 0;
    while (item < 2 && !member(s->fragment, items[item]))
        item++;
    snprintf(text, sizeof text, "%s %u%s%.60s, %s shading, %s reflection", items[item],
             (unsigned)whole(s->fragment, items[item]), object ? " of " : "", object ? object : "",
             strcmp(shading, "phong") == 0     ? "Phong"
             : strcmp(shading, "gouraud") == 0 ? "Gouraud"
                                               : "flat",
             text_of(s->fragment, "model"));
    put(d, at, 0, ALIGN_LEFT, INK, text);
    at->y += 18 * at->unit;
    if (!s->point)
        return;
    int adding = 0;
    const json_t *lights = member(s->point, "lights");
    for (size_t i = 0; i < json_array_size(lights); i++)
        adding += sum_of(element(lights, i), "diffuse_term") + sum_of(element(lights, i), "specular_term") > 0;
    const char *name = text_of(s->light, "name");
    if (!s->light)
        snprintf(text, sizeof text, "no light adds anything here");
    else
        snprintf(text, sizeof text, "%s: %s light%s%.60s%s%s", s->threads ? "l" : "l, r and h",
                 text_of(s->light, "type"), name ? " '" : "", name ? name : "", name ? "'" : "",
                 adding > 1 ? ", the strongest here" : "");
    if (json_is_integer(member(s->point, "corner")))
        snprintf(text + strlen(text), sizeof text - strlen(text), "; at corner %d, which is lit",
                 whole(s->point, "corner"));
    put(d, at, 0, ALIGN_LEFT, GREY, text);
}

// --- the page

static double unit_of(const struct figure *f)
{
    double shorter = f->width < f->height ? f->width : f->height, unit = shorter / 640;
    return unit > 0.75 ? unit : 0.75;
}

static double head_of(double unit) { return 52 * unit; }

// Returns the width of the left column, which contains the picture and, below it, the vectors from the side.
static double left_width(const struct figure *f)
{
    double side = 400 * unit_of(f);
    return f->width > side ? f->width : side;
}

// Adds to a text. Omits what does not fit.
__attribute__((format(printf, 2, 3))) static void add(char text[700], const char *format, ...)
{
    size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, 700 - used, format, arguments);
    va_end(arguments);
}

// Describes the figure in words for readers who cannot see it.
static bool describe(const struct figure *f, const struct subject *s, const char *title, struct drawing *d,
                     lam_error *error)
{
    char text[700] = "";
    add(text, "A picture of %d by %d pixels; the pixel %d,%d is explained.", f->width, f->height, f->x, f->y);
    if (!s->point)
        return drawing_describe(d, title, text, error);
    lam_vec3 n = s->vectors[0], v = s->vectors[2], l = s->vectors[1], t = s->vectors[5], sum = vector(s->point, "sum");
    add(text, " In eye space the normal n is (%.3g, %.3g, %.3g), the direction to the eye v is (%.3g, %.3g, %.3g)", n.x,
        n.y, n.z, v.x, v.y, v.z);
    if (s->light)
        add(text, ", and the direction to the light l is (%.3g, %.3g, %.3g)", l.x, l.y, l.z);
    if (s->threads)
        add(text, ", and the tangent t of the thread is (%.3g, %.3g, %.3g)", t.x, t.y, t.z);
    const json_t *bytes = member(f->explanation, "bytes");
    add(text, ". The terms' sum is (%.3g, %.3g, %.3g), and the pixel is %g %g %g with alpha %g.", sum.x, sum.y, sum.z,
        number_of(element(bytes, 0)), number_of(element(bytes, 1)), number_of(element(bytes, 2)),
        number_of(element(bytes, 3)));
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

static bool draw(const struct figure *f, const char *own_title, struct drawing *d, lam_error *error)
{
    const json_t *e = f->explanation;
    struct subject s = find_subject(f);
    double unit = unit_of(f);
    char title[256];
    const char *model = text_of(e, "model"), *slash = model ? strrchr(model, '/') : NULL;
    snprintf(title, sizeof title, "%.180s, pixel %d,%d",
             slash && slash[1] ? slash + 1
             : model           ? model
                               : "",
             f->x, f->y);
    const char *words = own_title ? own_title : title;
    struct point corner = {(int)(24 * unit), (int)head_of(unit)};
    struct sheet_layout at = {
        .unit = unit, .left = 24 * unit + left_width(f) + 28 * unit, .y = head_of(unit) + 10 * unit};
    at.right = at.left + (PANEL - 4) * unit;
    if (!describe(f, &s, words, d, error))
        return false;
    draw_text(d, (struct point){24 * unit, 34 * unit}, 20 * unit, ALIGN_LEFT, INK, words);
    if (!draw_image(d, &f->picture, (int)corner.x, (int)corner.y, words, error))
        return false;
    put_words(e, &s, d, &at);
    if (!s.point)
        return draw_ring(d, (struct point){corner.x + f->x + 0.5, corner.y + f->y + 0.5}, unit, error);
    at.y += 8 * unit;
    struct sheet_layout below = {
        .unit = unit, .left = corner.x, .right = corner.x + left_width(f), .y = corner.y + f->height};
    const json_t *map = f->figure == FIGURE_FOOTPRINT ? element(member(s.fragment, "maps"), 0) : NULL;
    bool ok = draw_vectors(f, &s, corner, unit, d, error) &&
              (map ? draw_footprint(map, (struct point){(below.left + below.right) / 2, below.y}, unit, d, error)
               : f->figure == FIGURE_BEAM && s.light ? draw_law(&s, &below, d, error)
                                                     : draw_from_the_side(&s, &below, d, error));
    return ok && put_places(s.fragment, d, &at, error) && put_vectors(&s, d, &at, error) &&
           put_light(s.light, d, &at, error) && put_terms(&s, d, &at, error) && put_steps(e, &s, d, &at, error);
}

// --- the request: a line of JSON about the page, the line of `lambent explain --json`, and the picture's pixels

// Reads the request. The explanation belongs to the caller, even on failure.
static bool read_request(const lam_bytes *request, struct figure *f, bool *svg, json_t **read, lam_error *error)
{
    const char *at = request->data, *end = at + request->size;
    for (int i = 0; i < 2; i++) {
        const char *line = at, *stop = at < end ? memchr(at, '\n', (size_t)(end - at)) : NULL;
        at = stop ? stop + 1 : end;
        read[i] = json_loadb(line, (size_t)(at - line), 0, NULL);
    }
    f->explanation = read[1];
    f->width = whole(read[1], "width");
    f->height = whole(read[1], "height");
    f->x = whole(read[1], "x");
    f->y = whole(read[1], "y");
    f->camera.fovy_rad = number(read[0], "fovy_rad");
    f->camera.ortho_half_height = number(read[0], "ortho_half_height");
    f->camera.fx = number(read[0], "fx");
    f->camera.fy = number(read[0], "fy");
    f->camera.cx = number(read[0], "cx");
    f->camera.cy = number(read[0], "cy");
    f->figure = whole(read[0], "figure");
    *svg = json_is_true(member(read[0], "svg"));
    // The picture is not changed.
    f->picture =
        (lam_image){.width = f->width, .height = f->height, .format = LAM_RGBA8, .pixels = (void *)(uintptr_t)at};
    bool fits = f->width > 0 && f->height > 0 && f->width <= SIDE_MAX && f->height <= SIDE_MAX;
    return (fits && text_of(read[1], "shading") && 4 * (size_t)f->width * (size_t)f->height == (size_t)(end - at)) ||
           complain(
               error, LAM_BAD_ARGUMENT,
               "lambent-classroom explain reads a request of `lambent explain MODEL X,Y -o FILE` of the same version");
}

bool classroom_figure(const struct options *o, const lam_bytes *request, lam_bytes *answer, lam_error *error)
{
    struct figure f = {0};
    struct drawing drawing;
    json_t *read[2];
    bool svg, ok = read_request(request, &f, &svg, read, error);
    double unit = unit_of(&f), rows = PANEL_HEIGHT * unit, left = f.height + SIDE_HEIGHT * unit;
    int width = (int)(left_width(&f) + (PANEL + 72) * unit);
    int height = (int)(head_of(unit) + (rows > left ? rows : left) + 24 * unit);
    if (ok && (ok = drawing_open(&drawing, width, height, svg, !o->captions.no_captions, o->captions.font, error))) {
        ok = draw(&f, o->captions.title, &drawing, error) && drawing_pack(&drawing, answer, error);
        drawing_free(&drawing);
    }
    json_decref(read[0]);
    json_decref(read[1]);
    return ok;
}

#ifndef CLASSROOM_INSIDE // a static program calls classroom_figure
// Answers with the page and exit code 0, or with the text of an error and its code. Without a request, lambent has
// reported an error, and expects no answer.
int run_figure(int operand_count, char **operands, const struct options *o)
{
    (void)operand_count, (void)operands;
    struct sandbox_paths paths = {0};
    struct child_bytes read = {0};
    enum child_read state = CHILD_READ;
    lam_bytes answer = {0};
    lam_error error = {0};
    bool ok = sandbox_start(o, &paths, &error);
    while (ok && state == CHILD_READ)
        state = child_read(STDIN_FILENO, &read, 1 << 16);
    ok = ok && (state == CHILD_CLOSED || complain(&error, LAM_MACHINE, "out of memory"));
    if (ok && read.size)
        ok = classroom_figure(o, &(lam_bytes){read.data, read.size}, &answer, &error);
    if (!ok)
        fputs(error.text, stdout);
    else if (answer.size)
        fwrite(answer.data, 1, answer.size, stdout);
    free(read.data);
    lam_bytes_free(&answer);
    return ok ? 0 : (int)error.code;
}
#endif
