// texture_taps.h: finds the texels that a point uses, and their weights, for LANES points at a time (docs/textures.md).
// Define LANES before including this file.
//
// Every lookup mixes four texels of a level and four texels of the next level, with three weights. Lookups of fewer
// texels use weights of 0, so the other texels do not change the result.
#ifndef TEXTURE_TAPS_H
#define TEXTURE_TAPS_H

#include "functions.h"
#include "texture_map.h"

// Coordinates beyond this limit have no fraction. Such coordinates are treated as 0, like NaN.
#define COORDINATE_MAX 2.0e9f

// Four texels of a level, stored like the rows of texture_taps.
struct tap_lanes {
    inum first, across, down;
    num right, lower;
};

struct taps_lanes {
    inum level;
    num next;
    struct tap_lanes at[2];
};

// --- position

// Wraps coordinates to 0…1.
LANE_FN num wrapped_of(num s, lam_wrap wrap)
{
    if (wrap == LAM_WRAP_CLAMP)
        return saturate(s);
    num known = pick(both(s > -COORDINATE_MAX, s < COORDINATE_MAX), s, num_of(0.0f));
    inum whole = floor_of(known);
    num part = known - num_of_int(whole);
    return wrap == LAM_WRAP_MIRROR ? pick((whole & 1) == 1, 1.0f - part, part) : part;
}

// Two neighbouring texels along a side of `size` texels: the first texel, the step to the second texel, and the weight
// of the second texel.
struct neighbours {
    inum first, step;
    num share;
};

LANE_FN struct neighbours linear_neighbours(num s, inum size, lam_wrap wrap)
{
    num x = s * num_of_int(size) - 0.5f;
    inum left = floor_of(x), right = left + 1, last = size - 1, zero = inum_of(0);
    num share = x - num_of_int(left);
    bool repeats = wrap == LAM_WRAP_REPEAT;
    left = ipick(left < 0, repeats ? last : zero, left);
    right = ipick(right > last, repeats ? zero : last, right);
    return (struct neighbours){left, right - left, share};
}

LANE_FN struct neighbours nearest_neighbours(num s, inum size)
{
    return (struct neighbours){imin_of(int_of(s * num_of_int(size)), size - 1), inum_of(0), num_of(0.0f)};
}

// `nearest` selects the lanes that need only one texel.
LANE_FN struct tap_lanes tap_of(const lam_texture_map *map, num s, num t, inum width, inum height, mask nearest)
{
    struct neighbours x = linear_neighbours(s, width, map->wrap_s), y = linear_neighbours(t, height, map->wrap_t);
    if (any_lane(nearest)) {
        struct neighbours near_x = nearest_neighbours(s, width), near_y = nearest_neighbours(t, height);
        x.first = ipick(nearest, near_x.first, x.first);
        y.first = ipick(nearest, near_y.first, y.first);
        x.step = ipick(nearest, near_x.step, x.step);
        y.step = ipick(nearest, near_y.step, y.step);
        x.share = pick(nearest, near_x.share, x.share);
        y.share = pick(nearest, near_y.share, y.share);
    }
    return (struct tap_lanes){wrap_add(wrap_mul(y.first, width), x.first), x.step, wrap_mul(y.step, width), x.share,
                              y.share};
}

// --- level of detail

// Returns the side length at given levels: `side` texels at level 0, halved and rounded down at each further level, but
// at least 1. The result is exact, because side lengths have at most 15 bits.
LANE_FN inum side_at(int side, inum level)
{
    return imax_of(floor_of((float)side * num_of_bits(shift_left(127 - level, 23))), inum_of(1));
}

// Returns the texels and weights for texture coordinates (after the map's transform) and levels of detail (OpenGL 4.6,
// section 8.14).
LANE_FN struct taps_lanes taps_of(const lam_texture_map *map, const struct texture_sampler *by, num s, num t,
                                  num detail)
{
    const struct texture_level *base = &map->texture->levels[0];
    float top = (float)(map->texture->level_count - 1);
    mask minified = detail > 0.0f;
    num within = min_of(positive(detail), num_of(top)), lower = num_of(0.0f);
    if (by->mip == LAM_MIP_LINEAR)
        lower = num_of_int(floor_of(within));
    else if (by->mip == LAM_MIP_NEAREST) // ⌈detail + ½⌉ − 1
        lower = min_of(pick(minified, num_of_int(-floor_of(-(within + 0.5f))) - 1.0f, num_of(0.0f)), num_of(top));
    num near_small = num_of(by->minify == LAM_FILTER_NEAREST), near_large = num_of(by->magnify == LAM_FILTER_NEAREST);
    mask nearest = pick(minified, near_small, near_large) != 0.0f;
    struct taps_lanes taps = {.level = int_of(lower)};
    s = wrapped_of(s, map->wrap_s);
    t = wrapped_of(t, map->wrap_t);
    inum width = side_at(base->width, taps.level), height = side_at(base->height, taps.level);
    taps.at[0] = taps.at[1] = tap_of(map, s, t, width, height, nearest);
    taps.next = num_of(0.0f);
    if (by->mip == LAM_MIP_LINEAR) {
        taps.next = within - lower;
        inum next_width = imax_of(shift_right(width, 1), inum_of(1));
        taps.at[1] = tap_of(map, s, t, next_width, imax_of(shift_right(height, 1), inum_of(1)), nearest);
    }
    return taps;
}

// --- points

struct texture_matrix {
    float m[2][3];
};

// Returns the transform from the mesh's texture coordinates to coordinates in the texture.
static inline struct texture_matrix texture_matrix_of(const lam_texture_map *map)
{
    struct texture_matrix matrix = {{{1, 0, 0}, {0, 1, 0}}};
    for (int i = 0; i < 6; i++)
        if (map->transform[i / 3][i % 3] != 0) {
            memcpy(matrix.m, map->transform, sizeof matrix.m);
            break;
        }
    return matrix;
}

LANE_FN num row_of(const float m[3], num s, num t) { return m[0] * s + m[1] * t; }

// Positions in the texture, the squared lengths of the two axes of each pixel's footprint in texels of level 0, and the
// level of detail. Footprints of zero or unknown size are treated as magnified.
struct footprints {
    num s, t, longer, shorter, detail;
};

LANE_FN struct footprints footprints_of(const lam_texture_map *map, const struct texture_matrix *matrix,
                                        const struct texture_points *points, int i)
{
    const float(*m)[3] = matrix->m;
    float width = (float)map->texture->levels[0].width, height = (float)map->texture->levels[0].height;
    num s = num_load(points->s + i), t = num_load(points->t + i);
    num ds_dx = num_load(points->ds_dx + i), dt_dx = num_load(points->dt_dx + i);
    num ds_dy = num_load(points->ds_dy + i), dt_dy = num_load(points->dt_dy + i);
    num xs = row_of(m[0], ds_dx, dt_dx) * width, xt = row_of(m[1], ds_dx, dt_dx) * height;
    num ys = row_of(m[0], ds_dy, dt_dy) * width, yt = row_of(m[1], ds_dy, dt_dy) * height;
    num x_square = xs * xs + xt * xt, y_square = ys * ys + yt * yt;
    num longer = max_of(x_square, y_square);
    // The factor 0.5 is the square root within the logarithm: log2 √longer.
    num detail = pick(longer > 1.0e-30f, 0.5f * log2_of(min_of(longer, num_of(1.0e30f))), num_of(-50.0f));
    return (struct footprints){row_of(m[0], s, t) + m[0][2], row_of(m[1], s, t) + m[1][2], longer,
                               min_of(x_square, y_square), detail};
}

// Footprints of which the longer axis is at most 1 / SQUARE times the shorter one are filtered like squares.
#define SQUARE 0.8f

// Selects the level of detail of a probe for long, minified footprints: the probe is as wide as the shorter axis, or
// wider if `most` such probes do not cover the longer axis. Returns how many probes cover the longer axis.
LANE_FN num probes_of(struct footprints *f, int most)
{
    mask minified = f->longer > 1.0f;
    num ratio = SQUARE * square_root(f->longer / max_of(f->shorter, num_of(1.0e-30f)));
    ratio = pick(minified, max_of(min_of(ratio, num_of((float)most)), num_of(1.0f)), num_of(1.0f));
    f->detail = pick(minified, f->detail - log2_of(ratio), f->detail);
    return ratio;
}

LANE_FN void store_tap(struct tap_rows *rows, int i, struct tap_lanes tap)
{
    inum_store(rows->first + i, tap.first);
    inum_store(rows->across + i, tap.across);
    inum_store(rows->down + i, tap.down);
    num_store(rows->right + i, tap.right);
    num_store(rows->lower + i, tap.lower);
}

LANE_FN void store_taps(struct texture_taps *taps, int i, struct taps_lanes found)
{
    inum_store(taps->level + i, found.level);
    num_store(taps->next + i, found.next);
    store_tap(&taps->at[0], i, found.at[0]);
    store_tap(&taps->at[1], i, found.at[1]);
}

// Fills the rows for `count` points, a multiple of LANES. `level` receives the level of detail of each point, or of each
// of its probes.
LANE_FN void find_taps(const lam_texture_map *map, const struct texture_sampler *sampler,
                       const struct texture_points *points, int count, struct texture_taps *taps, float *level)
{
    const struct texture_matrix matrix = texture_matrix_of(map);
    for (int i = 0; i < count; i += LANES) {
        struct footprints f = footprints_of(map, &matrix, points, i);
        num_store(taps->probes + i, sampler->probes > 1 ? probes_of(&f, sampler->probes) : num_of(1.0f));
        store_taps(taps, i, taps_of(map, sampler, f.s, f.t, f.detail));
        num_store(level + i, f.detail);
    }
}

#endif
