// plot_lobe.c: plots reflection lobes as a polar figure: for each direction v in the plane of n and l, the share of light
// that the surface reflects to v, relative to the largest share.
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console.h"
#include "options.h"

enum { INK = 0x222222, GREY = 0x9a9a9a, STEPS = 720 };

static double in_radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

// The angles of v and h are measured from the normal, positive towards r. The light is at −LOBE_LIGHT degrees.
static double share_of(const struct curve *c, double v)
{
    const double l = in_radians(LOBE_LIGHT), a = in_radians(v), n_l = cos(l), n_v = cos(a), half = (a - l) / 2;
    if (c->reflection == LAM_REFLECTION_LAMBERT)
        return 1;
    if (c->reflection == LAM_REFLECTION_PHONG)
        return pow(fmax(cos(a - l), 0), (double)c->shininess);
    if (c->reflection == LAM_REFLECTION_BLINN_PHONG)
        return pow(fmax(cos(half), 0), (double)c->shininess);
    // GGX (Walter et al. 2007) with the height-correlated masking of Smith, as in docs/lighting/physical.md
    const double r = c->number[0] * c->number[0], square = r * r, n_h = cos(half), across = sin(half);
    const double spread = across * across + n_h * n_h * square;
    const double masking =
        n_l * sqrt(n_v * n_v * (1 - square) + square) + n_v * sqrt(n_l * n_l * (1 - square) + square);
    return n_v > 0 ? square / (spread * spread) * (0.5 / masking) * n_l : 0;
}

static double lobe_value(const struct curve *c, double v) { return share_of(c, v) / c->number[1]; }

bool plot_add_lobe(struct plot *plot, const char *word, lam_error *error)
{
    static const struct {
        const char *name;
        lam_reflection reflection;
        double least, most; // of the number
    } rows[] = {{"phong", LAM_REFLECTION_PHONG, 0, 1e9},
                {"blinn-phong", LAM_REFLECTION_BLINN_PHONG, 0, 1e9},
                {"ggx", LAM_REFLECTION_GGX, 0.045, 1},
                {"lambert", LAM_REFLECTION_LAMBERT, 0, 0}};
    size_t length = strcspn(word, ":"), i = 0;
    double number = 0;
    const char *rest = word[length] ? read_number(word + length + 1, &number) : word + length;
    while (i < 4 && (strlen(rows[i].name) != length || memcmp(rows[i].name, word, length) != 0))
        i++;
    if (i == 4 || !rest || *rest || !word[length] != (i == 3) || number < rows[i].least || number > rows[i].most)
        return plot_wrong(error, "lobe", word,
                          "phong:SHININESS, blinn-phong:SHININESS, ggx:ROUGHNESS (0.045 to 1) or lambert");
    struct curve *curve = plot_add_curve(plot, lobe_value, error);
    if (!curve)
        return false;
    curve->reflection = rows[i].reflection;
    curve->shininess = (float)number;
    curve->style = (plot->count - 1) % 3; // Phong and Blinn–Phong with four times the shininess coincide
    curve->number[0] = number;
    for (int k = -STEPS; k <= STEPS; k++)
        curve->number[1] = fmax(curve->number[1], share_of(curve, 89.99 * k / STEPS));
    snprintf(curve->label, sizeof curve->label, i == 3 ? "lambert" : "%s:%.6g, peak %.4g", rows[i].name, number,
             curve->number[1]);
    return true;
}

static struct point at_angle(struct point foot, double length, double degrees)
{
    return (struct point){foot.x + length * sin(in_radians(degrees)), foot.y - length * cos(in_radians(degrees))};
}

static bool draw_vector(struct drawing *d, struct point foot, double length, double degrees, const char *name,
                        double unit, lam_error *error)
{
    struct point tip = at_angle(foot, length, degrees), back = at_angle(foot, length - 11 * unit, degrees);
    const double x = (tip.x - back.x) * 0.4, y = (tip.y - back.y) * 0.4;
    struct point line[2] = {foot, tip}, wings[3] = {{back.x - y, back.y + x}, tip, {back.x + y, back.y - x}};
    draw_text(d, at_angle((struct point){foot.x, foot.y + 5 * unit}, length + 14 * unit, degrees), 16 * unit,
              ALIGN_MIDDLE, INK, name);
    return draw_line(d, line, 2, 2 * unit, INK, 0, error) && draw_line(d, wings, 3, 2 * unit, INK, 0, error);
}

bool plot_draw_lobes(const struct plot *plot, struct drawing *d, lam_error *error)
{
    const double u = d->width / 800.0 < d->height / 500.0 ? d->width / 800.0 : d->height / 500.0, reach = 390 * u;
    struct point foot = {d->width / 2.0, d->height - 70 * u},
                 ground[2] = {{foot.x - 0.97 * reach, foot.y}, {foot.x + 0.97 * reach, foot.y}};
    draw_text(d, (struct point){d->width / 2.0, 32 * u}, 18 * u, ALIGN_MIDDLE, INK, plot->title);
    bool ok = draw_line(d, ground, 2, 2 * u, GREY, 0, error);
    for (int i = 0; ok && i < plot->count; i++) {
        const struct curve *c = &plot->curves[i];
        struct point line[2 * STEPS + 1];
        for (int k = -STEPS; k <= STEPS; k++)
            line[k + STEPS] = at_angle(foot, reach * lobe_value(c, 89.99 * k / STEPS), 89.99 * k / STEPS);
        ok = draw_line(d, line, 2 * STEPS + 1, 2.4 * u, c->color, plot_dash(c, u), error);
        double base = foot.y + (22 + 19 * (i / 3)) * u, left = (30 + 255 * (i % 3)) * u;
        struct point sample[2] = {{left, base - 5 * u}, {left + 26 * u, base - 5 * u}};
        ok = ok && draw_line(d, sample, 2, 2.4 * u, c->color, plot_dash(c, u), error);
        draw_text(d, (struct point){left + 34 * u, base}, 14 * u, ALIGN_LEFT, INK, c->label);
    }
    // For the eye in the direction of r, h is the normal; the figure shows h for an eye halfway between n and r.
    const double half = (LOBE_LIGHT / 2.0 - LOBE_LIGHT) / 2;
    return ok && draw_vector(d, foot, 0.7 * reach, 0, "n", u, error) &&
           draw_vector(d, foot, 0.7 * reach, -LOBE_LIGHT, "l", u, error) &&
           draw_vector(d, foot, 0.7 * reach, LOBE_LIGHT, "r", u, error) &&
           draw_vector(d, foot, 0.55 * reach, LOBE_LIGHT / 2.0, "v", u, error) &&
           draw_vector(d, foot, 0.7 * reach, half, "h", u, error);
}
