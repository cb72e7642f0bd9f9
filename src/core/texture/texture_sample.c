// texture_sample.c: fetches and filters the texels of points (docs/textures.md).
//
// texture_taps.h finds the texels of LANES points at a time. This file fetches and mixes these texels, four channels at
// a time. This file is plain C; the code for every instruction set calls it.
#define LANES 1
#include "texture_taps.h"

#include "float_state.h"

enum { AHEAD = 24 };

// --- fetching

static texel mix(texel a, texel b, float share) { return a + (b - a) * share; }

static texel mix_four(const texel four[4], float right, float lower)
{
    return mix(mix(four[0], four[1], right), mix(four[2], four[3], right), lower);
}

// Returns the mix of a level's texels at a tap. `channels` is a constant after inlining; if it is 3, the fourth number
// of the result is arbitrary.
static inline __attribute__((always_inline)) texel fetch_tap(const struct lam_texture *texture, int channels, int level,
                                                             int32_t first, int32_t across, int32_t down, float right,
                                                             float lower)
{
    const float *floats = texture->levels[level].floats, *decode = texture->decode;
    ptrdiff_t at = channels * (ptrdiff_t)first, to_right = channels * (ptrdiff_t)across,
              to_lower = channels * (ptrdiff_t)down;
    if (floats) {
        const float *upper = floats + at, *below = upper + to_lower;
        return mix_four((texel[4]){texel_of_floats(upper, 4), texel_of_floats(upper + to_right, 4),
                                   texel_of_floats(below, 4), texel_of_floats(below + to_right, 4)},
                        right, lower);
    }
    const uint8_t *upper = texture->bytes + at, *below = upper + to_lower;
    return mix_four(
        (texel[4]){texel_of_bytes(upper, decode, channels), texel_of_bytes(upper + to_right, decode, channels),
                   texel_of_bytes(below, decode, channels), texel_of_bytes(below + to_right, decode, channels)},
        right, lower);
}

// Prefetches the texels of a later point, because textures are larger than the processor's caches. Two neighbouring
// texels can be in two cache lines.
static inline __attribute__((always_inline)) void prefetch_tap(const struct lam_texture *texture, int channels,
                                                               int level, int32_t first, int32_t down)
{
    const struct texture_level *l = &texture->levels[level];
    ptrdiff_t size = l->floats ? (ptrdiff_t)sizeof(float) : 1, step = channels * size, last = step + 4 * size - 1;
    const char *at = (l->floats ? (const char *)l->floats : (const char *)texture->bytes) + first * step;
    __builtin_prefetch(at);
    __builtin_prefetch(at + last);
    __builtin_prefetch(at + down * step);
    __builtin_prefetch(at + down * step + last);
}

// --- one point

static texel fetch_one(const struct lam_texture *texture, int level, const struct tap_lanes *tap)
{
    return fetch_tap(texture, texture->channels, level, tap->first, tap->across, tap->down, tap->right, tap->lower);
}

// Returns the filtered texel at a level of detail.
static texel at_level(const lam_texture_map *map, const struct texture_sampler *sampler, float s, float t, float detail)
{
    struct taps_lanes taps = taps_of(map, sampler, s, t, detail);
    texel value = fetch_one(map->texture, taps.level, &taps.at[0]);
    if (taps.next != 0)
        value = mix(value, fetch_one(map->texture, taps.level + 1, &taps.at[1]), taps.next);
    if (map->texture->channels == 3)
        value[3] = 1;
    return value;
}

// --- many points

static inline __attribute__((always_inline)) void fetch_rows(const struct lam_texture *texture, int channels,
                                                             const struct texture_taps *taps, int count,
                                                             float *const out[4])
{
    const struct tap_rows *one = &taps->at[0], *two = &taps->at[1];
    for (int i = 0; i < count; i++) {
        int level = taps->level[i], later = i + AHEAD;
        if (later < count) {
            prefetch_tap(texture, channels, taps->level[later], one->first[later], one->down[later]);
            if (taps->next[later] != 0)
                prefetch_tap(texture, channels, taps->level[later] + 1, two->first[later], two->down[later]);
        }
        if (taps->probes[i] > 1.0f)
            continue;
        texel value = fetch_tap(texture, channels, level, one->first[i], one->across[i], one->down[i], one->right[i],
                                one->lower[i]);
        if (taps->next[i] != 0)
            value = mix(value,
                        fetch_tap(texture, channels, level + 1, two->first[i], two->across[i], two->down[i],
                                  two->right[i], two->lower[i]),
                        taps->next[i]);
        for (int channel = 0; channel < channels; channel++)
            out[channel][i] = value[channel];
    }
    for (int i = 0; channels == 3 && i < count; i++)
        out[3][i] = 1;
}

void texture_fetch(const struct lam_texture *texture, const struct texture_taps *taps, int count, float *const out[4])
{
    if (texture->channels == 3)
        fetch_rows(texture, 3, taps, count, out);
    else
        fetch_rows(texture, 4, taps, count, out);
}

static texel at_coordinates(const lam_texture_map *map, float s, float t, float level)
{
    const struct texture_matrix matrix = texture_matrix_of(map);
    const float(*m)[3] = matrix.m;
    const struct texture_sampler sampler = texture_map_sampler(map);
    return at_level(map, &sampler, row_of(m[0], s, t) + m[0][2], row_of(m[1], s, t) + m[1][2], level);
}

texel texture_map_base(const lam_texture_map *map, float s, float t) { return at_coordinates(map, s, t, 0); }

lam_rgba lam_texture_sample(const lam_texture_map *map, double s, double t, double level)
{
    if (!map || !map->texture || !texture_map_check(map, "map", NULL))
        return (lam_rgba){0, 0, 0, 0};
    uint64_t state = float_state_enter();
    texel value = at_coordinates(map, (float)s, (float)t, (float)level);
    float_state_leave(state);
    float scale = map->scale != 0 ? map->scale : 1;
    value = value * scale + map->offset;
    return (lam_rgba){value[0], value[1], value[2], value[3]};
}
