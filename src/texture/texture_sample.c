// texture_sample.c: texels around a point, filtered (docs/textures.md).
//
// Plain C with vectors of four channels: the kernels of every instruction set call this one function, so its bits are the
// same for all of them.
#define LANES 1
#include "functions.h"

#include "float_state.h"
#include "texture_map.h"

enum { PROBES_MAX = 16 };

// The largest whole number ≤ x, for |x| < 2³¹; beyond, and for NaN, 0: such coordinates have no fraction left.
static int floor_whole(float x)
{
    if (!(x > -2.0e9f && x < 2.0e9f))
        return 0;
    int whole = (int)x;
    return whole - ((float)whole > x);
}

// A coordinate as a place in the picture, 0…1.
static float wrapped(float s, lam_wrap wrap)
{
    if (!(s > -2.0e9f && s < 2.0e9f))
        return s >= 2.0e9f && wrap == LAM_WRAP_CLAMP ? 1.0f : 0.0f;
    if (wrap == LAM_WRAP_CLAMP)
        return s < 0 ? 0.0f : s > 1 ? 1.0f : s;
    int whole = floor_whole(s);
    float part = s - (float)whole;
    return wrap == LAM_WRAP_MIRROR && whole & 1 ? 1.0f - part : part;
}

// A texel's number that is one beyond the picture.
static int neighbour(int i, int size, lam_wrap wrap)
{
    if (i >= 0 && i < size)
        return i;
    if (wrap == LAM_WRAP_REPEAT)
        return i < 0 ? size - 1 : 0;
    return i < 0 ? 0 : size - 1;
}

static texel mix(texel a, texel b, float share) { return a + (b - a) * share; }

// `s` and `t` are wrapped.
static texel nearest(const lam_texture_map *map, int level, float s, float t)
{
    const struct texture_level *l = &map->texture->levels[level];
    int x = (int)(s * (float)l->width), y = (int)(t * (float)l->height);
    return texel_at(map->texture, level, x < l->width ? x : l->width - 1, y < l->height ? y : l->height - 1);
}

static texel linear(const lam_texture_map *map, int level, float s, float t)
{
    const struct lam_texture *texture = map->texture;
    const struct texture_level *l = &texture->levels[level];
    float x = s * (float)l->width - 0.5f, y = t * (float)l->height - 0.5f;
    int left = floor_whole(x), top = floor_whole(y);
    float right_share = x - (float)left, bottom_share = y - (float)top;
    int x0 = neighbour(left, l->width, map->wrap_s), x1 = neighbour(left + 1, l->width, map->wrap_s);
    int y0 = neighbour(top, l->height, map->wrap_t), y1 = neighbour(top + 1, l->height, map->wrap_t);
    texel upper = mix(texel_at(texture, level, x0, y0), texel_at(texture, level, x1, y0), right_share);
    texel lower = mix(texel_at(texture, level, x0, y1), texel_at(texture, level, x1, y1), right_share);
    return mix(upper, lower, bottom_share);
}

static texel filtered(const lam_texture_map *map, lam_filter filter, int level, float s, float t)
{
    return filter == LAM_FILTER_NEAREST ? nearest(map, level, s, t) : linear(map, level, s, t);
}

// A picture's place at a level of detail (OpenGL 4.6, section 8.14).
static texel at_level(const lam_texture_map *map, float s, float t, float detail)
{
    int last = map->texture->level_count - 1;
    s = wrapped(s, map->wrap_s);
    t = wrapped(t, map->wrap_t);
    if (!(detail > 0))
        return filtered(map, map->magnify, 0, s, t);
    if (map->mip == LAM_MIP_NONE)
        return filtered(map, map->minify, 0, s, t);
    float top = (float)last;
    if (map->mip == LAM_MIP_NEAREST) {
        int level = detail >= top ? last : -floor_whole(-(detail + 0.5f)) - 1; // ⌈detail + ½⌉ − 1
        return filtered(map, map->minify, level < last ? level : last, s, t);
    }
    if (detail >= top)
        return filtered(map, map->minify, last, s, t);
    int level = floor_whole(detail);
    return mix(filtered(map, map->minify, level, s, t), filtered(map, map->minify, level + 1, s, t),
               detail - (float)level);
}

// --- from the mesh's texture coordinates to the picture's

struct matrix {
    float m[2][3];
};

static struct matrix matrix_of(const lam_texture_map *map)
{
    struct matrix matrix = {{{1, 0, 0}, {0, 1, 0}}};
    for (int i = 0; i < 6; i++)
        if (map->transform[i / 3][i % 3] != 0) {
            memcpy(matrix.m, map->transform, sizeof matrix.m);
            break;
        }
    return matrix;
}

static float row(const float m[3], float s, float t) { return m[0] * s + m[1] * t; }

// One point with a footprint of several probes along its longer axis (convention 22).
static texel anisotropic(const lam_texture_map *map, float s, float t, const float x[2], const float y[2], float longer,
                         float shorter, int most, float *level)
{
    const struct texture_level *l = &map->texture->levels[0];
    float ratio = shorter > 0 ? longer / shorter : (float)most;
    int probes = ratio >= (float)most ? most : -floor_whole(-ratio);
    probes = probes < 1 ? 1 : probes;
    float xs = x[0] * (float)l->width, xt = x[1] * (float)l->height, ys = y[0] * (float)l->width,
          yt = y[1] * (float)l->height;
    const float *axis = xs * xs + xt * xt >= ys * ys + yt * yt ? x : y;
    *level = log2_of(max_of(longer / (float)probes, 1.0e-30f));
    texel sum = {0, 0, 0, 0};
    for (int i = 0; i < probes; i++) {
        float along = ((float)i + 0.5f) / (float)probes - 0.5f;
        sum += at_level(map, s + axis[0] * along, t + axis[1] * along, *level);
    }
    return sum * (1.0f / (float)probes);
}

void texture_map_texels(const lam_texture_map *map, const struct texture_points *points, int count, int anisotropy,
                        float *const out[4], float *level)
{
    const struct matrix matrix = matrix_of(map);
    const float(*m)[3] = matrix.m;
    float width = (float)map->texture->levels[0].width, height = (float)map->texture->levels[0].height;
    int most = anisotropy < PROBES_MAX ? anisotropy : PROBES_MAX;
    for (int i = 0; i < count; i++) {
        float s = row(m[0], points->s[i], points->t[i]) + m[0][2], t = row(m[1], points->s[i], points->t[i]) + m[1][2];
        float x[2] = {row(m[0], points->ds_dx[i], points->dt_dx[i]), row(m[1], points->ds_dx[i], points->dt_dx[i])};
        float y[2] = {row(m[0], points->ds_dy[i], points->dt_dy[i]), row(m[1], points->ds_dy[i], points->dt_dy[i])};
        float x_square = x[0] * width * (x[0] * width) + x[1] * height * (x[1] * height);
        float y_square = y[0] * width * (y[0] * width) + y[1] * height * (y[1] * height);
        float longer = max_of(x_square, y_square), shorter = min_of(x_square, y_square);
        // The root is in the logarithm: log2 √longer. Footprints of no size, and of none that is known, are magnified.
        float detail = longer > 1.0e-30f ? 0.5f * log2_of(min_of(longer, 1.0e30f)) : -50.0f;
        texel value = most > 1 && detail > 0
                          ? anisotropic(map, s, t, x, y, square_root(longer), square_root(shorter), most, &detail)
                          : at_level(map, s, t, detail);
        for (int channel = 0; channel < 4; channel++)
            out[channel][i] = value[channel];
        if (level)
            level[i] = detail;
    }
}

texel texture_map_base(const lam_texture_map *map, float s, float t)
{
    const struct matrix matrix = matrix_of(map);
    return at_level(map, row(matrix.m[0], s, t) + matrix.m[0][2], row(matrix.m[1], s, t) + matrix.m[1][2], 0);
}

lam_rgba lam_texture_sample(const lam_texture_map *map, double s, double t, double level)
{
    if (!map || !map->texture || !texture_map_check(map, "map", NULL))
        return (lam_rgba){0, 0, 0, 0};
    uint64_t state = float_state_enter();
    const struct matrix matrix = matrix_of(map);
    texel value = at_level(map, row(matrix.m[0], (float)s, (float)t) + matrix.m[0][2],
                           row(matrix.m[1], (float)s, (float)t) + matrix.m[1][2], (float)level);
    float_state_leave(state);
    float scale = map->scale != 0 ? map->scale : 1;
    value = value * scale + map->offset;
    return (lam_rgba){value[0], value[1], value[2], value[3]};
}
