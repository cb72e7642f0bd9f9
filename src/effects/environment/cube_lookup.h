// cube_lookup.h: looks up LANES directions in a cube map. Define LANES before including this file (lanes.h).
#ifndef CUBE_LOOKUP_H
#define CUBE_LOOKUP_H

#include "cube_map.h"
#include "lanes.h"

struct cube_color {
    num r, g, b;
};

// The intersection of a direction with the cube, in texels of the bordered face, ½ … size + 1½. For the zero vector,
// the point is arbitrary.
struct cube_position {
    inum face;
    num s, t;
};

// A direction in the coordinates of the face that it intersects. The intersection is at (across ÷ major, down ÷ major).
struct cube_side {
    inum face;
    num across, down, major;
};

LANE_FN struct cube_side cube_side(num x, num y, num z)
{
    num ax = absolute(x), ay = absolute(y), az = absolute(z);
    mask on_x = both(ax >= ay, ax >= az), on_y = both(negate(on_x), ay >= az);
    inum sign = bits_of(pick(on_x, x, pick(on_y, y, z))) & INT32_MIN, minus = inum_of(INT32_MIN);
    struct cube_side side = {.major = pick(on_x, ax, pick(on_y, ay, az))};
    side.across = num_of_bits(bits_of(pick(on_x, num_of_bits(bits_of(z) ^ minus), x)) ^ ipick(on_y, inum_of(0), sign));
    side.down = num_of_bits(ipick(on_y, bits_of(z) ^ sign, bits_of(y) ^ minus));
    inum axis = ipick(on_x, inum_of(LAM_FACE_PX), ipick(on_y, inum_of(LAM_FACE_PY), inum_of(LAM_FACE_PZ)));
    side.face = axis + (shift_right(sign, 31) & 1);
    return side;
}

// Returns the face that a direction intersects, and the coordinates of the intersection, from −1 to 1. For the zero
// vector, the coordinates are NaN.
LANE_FN struct cube_position cube_point(num x, num y, num z)
{
    struct cube_side side = cube_side(x, y, z);
    return (struct cube_position){side.face, side.across / side.major, side.down / side.major};
}

// As in the table of OpenGL 4.6, section 8.13, the axis with the largest magnitude selects the face. If magnitudes are
// equal, either face may be used, because the filter is continuous.
LANE_FN struct cube_position cube_position(num x, num y, num z, int size)
{
    float half = 0.5f * (float)size, middle = half + 0.5f;
    num min = num_of(0.5f), max = num_of((float)size + 0.5f);
    struct cube_position at = cube_point(x, y, z);
    // The clamp also replaces NaN (from 0/0) with `min`.
    at.s = min_of(max_of(at.s * half + middle, min), max);
    at.t = min_of(max_of(at.t * half + middle, min), max);
    return at;
}

LANE_FN num cube_mix(const float from[4][LANES], num s, num t)
{
    num a = num_load(from[0]), b = num_load(from[1]), c = num_load(from[2]), d = num_load(from[3]);
    num upper = a + (b - a) * s, lower = c + (d - c) * s;
    return upper + (lower - upper) * t;
}

LANE_FN struct cube_color cube_look(const struct lam_environment *cube, num x, num y, num z)
{
    struct cube_position at = cube_position(x, y, z, cube->size);
    inum column = int_of(at.s), row = int_of(at.t);
    float texels[3][4][LANES];
    size_t stride = cube_row(cube);
    for (int i = 0; i < LANES; i++) {
        const float *from = cube_texel(cube, ilane(at.face, i), ilane(column, i) - 1, ilane(row, i) - 1);
        for (int channel = 0; channel < 3; channel++) {
            texels[channel][0][i] = from[channel];
            texels[channel][1][i] = from[channel + 3];
            texels[channel][2][i] = from[stride + (size_t)channel];
            texels[channel][3][i] = from[stride + (size_t)channel + 3];
        }
    }
    num s = at.s - num_of_int(column), t = at.t - num_of_int(row);
    return (struct cube_color){cube_mix(texels[0], s, t), cube_mix(texels[1], s, t), cube_mix(texels[2], s, t)};
}

#endif
