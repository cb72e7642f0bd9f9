// prefiltered_lookup.h: looks up LANES directions in the levels of a prefiltered environment. Define LANES before
// including this file.
#ifndef PREFILTERED_LOOKUP_H
#define PREFILTERED_LOOKUP_H

#include "cube_lookup.h"
#include "environment_light.h"

// Returns, for each lane, the light of level `number` at a point on a face (cube_point).
LANE_FN struct cube_color level_look(const struct environment_light *light, inum number, struct cube_position point)
{
    float sizes[LANES], texels[3][4][LANES];
    for (int i = 0; i < LANES; i++)
        sizes[i] = (float)light->level[ilane(number, i)].size;
    num half = 0.5f * num_load(sizes), middle = half + 0.5f, min = num_of(0.5f), max = num_load(sizes) + 0.5f;
    num across = min_of(max_of(point.s * half + middle, min), max);
    num down = min_of(max_of(point.t * half + middle, min), max);
    inum column = int_of(across), row = int_of(down);
    for (int i = 0; i < LANES; i++) {
        const struct lam_environment *cube = &light->level[ilane(number, i)];
        const float *from = cube_texel(cube, ilane(point.face, i), ilane(column, i) - 1, ilane(row, i) - 1);
        const float *below = from + cube_row(cube);
        for (int channel = 0; channel < 3; channel++) {
            texels[channel][0][i] = from[channel];
            texels[channel][1][i] = from[channel + 3];
            texels[channel][2][i] = below[channel];
            texels[channel][3][i] = below[channel + 3];
        }
    }
    num s = across - num_of_int(column), t = down - num_of_int(row);
    return (struct cube_color){cube_mix(texels[0], s, t), cube_mix(texels[1], s, t), cube_mix(texels[2], s, t)};
}

// Returns the light around a direction, interpolated between two levels. `level` is 0 … ENVIRONMENT_LEVELS − 1
// (prefilter_level).
LANE_FN struct cube_color prefiltered_look(const struct environment_light *light, num level, num x, num y, num z)
{
    struct cube_position point = cube_point(x, y, z);
    num first = num_of_int(int_of(min_of(level, num_of((float)(ENVIRONMENT_LEVELS - 2)))));
    num part = level - first;
    struct cube_color a = level_look(light, int_of(first), point);
    struct cube_color b = level_look(light, int_of(first + 1.0f), point);
    return (struct cube_color){a.r + (b.r - a.r) * part, a.g + (b.g - a.g) * part, a.b + (b.b - a.b) * part};
}

#endif
