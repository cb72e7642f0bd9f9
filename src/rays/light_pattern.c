// light_pattern.c: the points of a light with a size.
#include "light_pattern.h"

#include "linear.h"

static void add_point(struct light_points *points, double radius, double angle)
{
    points->x[points->count] = radius * math_cos(angle);
    points->y[points->count++] = radius * math_sin(angle);
}

void light_pattern_fill(struct light_pattern *pattern, int count)
{
    static const double golden_angle = 2.39996322972865332;
    const int inner = LIGHT_PROBES - LIGHT_RIM_PROBES;
    pattern->probes.count = pattern->all.count = 0;
    for (int i = 0; i < LIGHT_RIM_PROBES && count > LIGHT_PROBES; i++)
        add_point(&pattern->probes, 1, 2 * PI * i / LIGHT_RIM_PROBES);
    for (int i = 0; i < inner && count > LIGHT_PROBES; i++)
        add_point(&pattern->probes, 0.5, 2 * PI * (i + 0.5) / inner);
    for (int i = 0; i < count; i++)
        add_point(&pattern->all, math_sqrt((i + 0.5) / count), golden_angle * i);
}
