// light_pattern.c: computes sample points on a light with a size.
#include "rays.h"

#include "linear.h"

static void add_point(struct light_points *points, double radius, double angle)
{
    points->x[points->count] = radius * math_cos(angle);
    points->y[points->count++] = radius * math_sin(angle);
}

void light_pattern_fill(struct light_pattern *pattern, int count)
{
    static const double golden_angle = 2.39996322972865332;
    pattern->probes.count = pattern->all.count = 0;
    for (int i = LIGHT_PROBES - 1; i >= 0 && count > LIGHT_PROBES; i--)
        add_point(&pattern->probes, math_sqrt(i / (LIGHT_PROBES - 1.0)), golden_angle * i);
    for (int i = 0; i < count; i++)
        add_point(&pattern->all, math_sqrt((i + 0.5) / count), golden_angle * i);
    pattern->cell.count = pattern->few.count = 0;
    for (int i = 0; i < LIGHT_FEW; i++)
        add_point(&pattern->few, math_sqrt((i + 0.5) / LIGHT_FEW), golden_angle * i);
    for (int i = 0; i < COVER_POINTS; i++) {
        double radius = math_sqrt((i + 0.5) / COVER_POINTS), angle = golden_angle * i;
        pattern->cover[0][i] = (float)(radius * math_cos(angle));
        pattern->cover[1][i] = (float)(radius * math_sin(angle));
    }
    for (int i = 0; i < CELL_PROBES; i++) // every other point is at the rim, which a shadow reaches first
        add_point(&pattern->cell, i & 1 ? 1 : math_sqrt((i + 0.5) / CELL_PROBES), golden_angle * i);
}
