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
}
