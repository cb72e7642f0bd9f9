// light_pattern.c: computes sample points on a light with a size.
#include "rays.h"

#include "linear.h"

static void add_point(struct light_points *points, double radius, double angle)
{
    points->x[points->count] = radius * math_cos(angle);
    points->y[points->count++] = radius * math_sin(angle);
}

static const double golden_angle = 2.39996322972865332;

// Adds the points of the spiral in rings, and in each ring by their angles.
static void fill_cover(struct light_pattern *pattern)
{
    static const int groups_of_ring[] = {1, 5, 10, 16};
    struct {
        double turn;
        int number;
    } points[COVER_POINTS];
    for (int ring = 0, first = 0; ring < 4; first += COVER_GROUP * groups_of_ring[ring++])
        for (int i = first; i < first + COVER_GROUP * groups_of_ring[ring]; i++) {
            const double turns = golden_angle / 6.28318530717958648 * i, turn = turns - (double)(int)turns;
            int at = i;
            for (; at > first && points[at - 1].turn > turn; at--)
                points[at] = points[at - 1];
            points[at].turn = turn;
            points[at].number = i;
        }
    for (int i = 0; i < COVER_POINTS; i++) {
        const double radius = math_sqrt((points[i].number + 0.5) / COVER_POINTS),
                     angle = golden_angle * points[i].number;
        pattern->cover[0][i] = (float)(radius * math_cos(angle));
        pattern->cover[1][i] = (float)(radius * math_sin(angle));
    }
    for (int g = 0; g < COVER_GROUPS; g++) {
        const float *x = pattern->cover[0] + COVER_GROUP * g, *y = pattern->cover[1] + COVER_GROUP * g;
        double middle[2] = {0}, square = 0;
        for (int i = 0; i < COVER_GROUP; i++) {
            middle[0] += (double)x[i] / COVER_GROUP;
            middle[1] += (double)y[i] / COVER_GROUP;
        }
        for (int i = 0; i < COVER_GROUP; i++) {
            const double dx = (double)x[i] - middle[0], dy = (double)y[i] - middle[1];
            square = dx * dx + dy * dy > square ? dx * dx + dy * dy : square;
        }
        pattern->group[0][g] = (float)middle[0];
        pattern->group[1][g] = (float)middle[1];
        pattern->group[2][g] = (float)math_sqrt(square);
    }
}

void light_pattern_fill(struct light_pattern *pattern, int count)
{
    pattern->probes.count = pattern->all.count = 0;
    for (int i = LIGHT_PROBES - 1; i >= 0 && count > LIGHT_PROBES; i--)
        add_point(&pattern->probes, math_sqrt(i / (LIGHT_PROBES - 1.0)), golden_angle * i);
    for (int i = 0; i < count; i++)
        add_point(&pattern->all, math_sqrt((i + 0.5) / count), golden_angle * i);
    pattern->cell.count = pattern->few.count = 0;
    for (int i = 0; i < LIGHT_FEW; i++)
        add_point(&pattern->few, math_sqrt((i + 0.5) / LIGHT_FEW), golden_angle * i);
    fill_cover(pattern);
    for (int i = 0; i < CELL_PROBES; i++) // every other point is at the rim, which a shadow reaches first
        add_point(&pattern->cell, i & 1 ? 1 : math_sqrt((i + 0.5) / CELL_PROBES), golden_angle * i);
}
