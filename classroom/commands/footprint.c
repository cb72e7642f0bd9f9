// footprint.c: draws the area that a pixel covers in a texture (explain --figure footprint).
#include "footprint.h"

#include <stdint.h>
#include <stdio.h>

// A grid of texels around the pixel's place in the texture.
struct texel_grid {
    struct point middle; // of the panel
    double side;         // of the panel
    double cell;         // the texels of level 0 along a square of the grid: a power of two
    double scale;        // panel units per texel of level 0
};

enum { GRID_CELLS = 16, INK = 0x222222, GREY = 0x707070, RULE = 0xd8d8d8, AREA = 0x0072b2, PROBE = 0xd55e00 };

static struct point pair_of(const json_t *map, const char *key)
{
    const json_t *pair = json_object_get(map, key);
    return (struct point){json_number_value(json_array_get(pair, 0)), json_number_value(json_array_get(pair, 1))};
}

static bool draw_grid(const struct texel_grid *g, struct point place, struct drawing *d, lam_error *error)
{
    const double half = g->side / 2;
    for (int i = 0; i < 2 * GRID_CELLS; i++) {
        const bool vertical = i % 2;
        const double position = vertical ? place.x : place.y, first = position / g->cell;
        const double off =
            ((double)(i / 2 - GRID_CELLS / 2 + 1) - (first - (double)(int64_t)first)) * g->cell * g->scale;
        const struct point m = g->middle;
        const struct point upright[2] = {{m.x + off, m.y - half}, {m.x + off, m.y + half}};
        const struct point level[2] = {{m.x - half, m.y + off}, {m.x + half, m.y + off}};
        if (off <= half && !draw_line(d, vertical ? upright : level, 2, 1, RULE, 0, error))
            return false;
    }
    return true;
}

// Draws a closed parallelogram: its middle, and its two sides in texels.
static bool draw_area(const struct texel_grid *g, struct point middle, struct point a, struct point b, double width,
                      uint32_t color, struct drawing *d, lam_error *error)
{
    struct point corners[5];
    for (int i = 0; i < 5; i++) {
        const double s = (i % 4 == 1 || i % 4 == 2 ? 0.5 : -0.5) * g->scale, t = (i % 4 >= 2 ? 0.5 : -0.5) * g->scale;
        corners[i] = (struct point){middle.x + s * a.x + t * b.x, middle.y + s * a.y + t * b.y};
    }
    return draw_line(d, corners, 5, width, color, 0, error);
}

// 2^x.
static double power_of_two(double x)
{
    double power = 1, root = 2;
    for (; x >= 1; x--)
        power *= 2;
    for (; x < 0; x++)
        power /= 2;
    for (int i = 0; i < 24; i++) {
        root = __builtin_sqrt(root);
        x *= 2;
        if (x >= 1) {
            power *= root;
            x--;
        }
    }
    return power;
}

// Draws the area that the pixel covers in the texture, and for each probe of the filter a square: a texel of the level
// of detail.
bool draw_footprint(const json_t *map, struct point top, double u, struct drawing *d, lam_error *error)
{
    const double probes = json_number_value(json_object_get(map, "probes")),
                 level = json_number_value(json_object_get(map, "level"));
    const struct point a = pair_of(map, "across"), b = pair_of(map, "down");
    const struct point axis = a.x * a.x + a.y * a.y >= b.x * b.x + b.y * b.y ? a : b;
    // The axis is divided into cells as long as a probe; the last one may be shorter. A magnified probe is a texel.
    const double width = power_of_two(level), size = width > 1 ? width : 1;
    const double cells = probes > 1 ? __builtin_sqrt(axis.x * axis.x + axis.y * axis.y) / width : 1;
    struct texel_grid g = {.side = 144 * u, .cell = 1};
    g.middle = (struct point){top.x - 76 * u, top.y + 20 * u + g.side / 2};
    const double wide = __builtin_fabs(a.x) + __builtin_fabs(b.x), high = __builtin_fabs(a.y) + __builtin_fabs(b.y);
    while (g.cell * GRID_CELLS < size + (wide > high ? wide : high))
        g.cell *= 2;
    g.scale = g.side / (GRID_CELLS * g.cell);
    bool ok = draw_grid(&g, pair_of(map, "place"), d, error) && draw_area(&g, g.middle, a, b, 2 * u, AREA, d, error);
    for (double k = 0; ok && k < probes; k++) {
        const double cell = cells - k < 1 ? cells - k : 1, along = g.scale * ((k + cell / 2) / cells - 0.5);
        const struct point p = {g.middle.x + along * axis.x, g.middle.y + along * axis.y};
        ok = draw_area(&g, p, (struct point){size, 0}, (struct point){0, size}, u, PROBE, d, error) &&
             draw_dot(d, p, 2 * u, PROBE, error);
    }
    char text[5][160];
    const uint32_t colors[5] = {INK, GREY, AREA, PROBE, PROBE};
    snprintf(text[0], sizeof *text, "The map '%.100s'", json_string_value(json_object_get(map, "map")));
    snprintf(text[1], sizeof *text, "one square: %g × %g texels", g.cell, g.cell);
    snprintf(text[2], sizeof *text, "footprint of the pixel");
    snprintf(text[3], sizeof *text, "probes: %g; texels per probe: %.4g", probes, size);
    snprintf(text[4], sizeof *text, "level of detail: %.6g", level);
    for (int i = 0; i < 5; i++)
        draw_text(d, (struct point){g.middle.x + g.side / 2 + 14 * u, g.middle.y - g.side / 2 + (30 + 24 * i) * u},
                  12.5 * u, ALIGN_LEFT, colors[i], text[i]);
    return ok;
}
