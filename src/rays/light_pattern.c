// light_pattern.c: the points of a light with a size.
#include "light_pattern.h"

#include "linear.h"

void light_pattern_fill(struct light_pattern *pattern, int count)
{
    static const double golden_angle = 2.39996322972865332;
    pattern->count = count;
    for (int i = 0; i < count; i++) {
        double radius = math_sqrt((i + 0.5) / count);
        pattern->x[i] = radius * math_cos(golden_angle * i);
        pattern->y[i] = radius * math_sin(golden_angle * i);
    }
    for (int i = 0; i < LIGHT_TURNS; i++) {
        pattern->cosine[i] = math_cos(2 * PI * i / LIGHT_TURNS);
        pattern->sine[i] = math_sin(2 * PI * i / LIGHT_TURNS);
    }
}
