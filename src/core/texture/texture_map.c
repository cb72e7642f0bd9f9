// texture_map.c: checks maps, and compares them.
#include "texture_map.h"
#include "fail.h"

#include <string.h>

bool texture_map_check(const lam_texture_map *map, const char *name, lam_error *error)
{
    if (!check_reserved(name, map, error))
        return false;
    if (!map->texture)
        return fail(error, LAM_BAD_ARGUMENT, "%s: texture is NULL", name);
    const struct {
        const char *name;
        int value, end;
    } choices[] = {{"texcoords", map->texcoords, 2},
                   {"wrap_s", (int)map->wrap_s, LAM_WRAP_COUNT},
                   {"wrap_t", (int)map->wrap_t, LAM_WRAP_COUNT},
                   {"magnify", (int)map->magnify, LAM_FILTER_COUNT},
                   {"minify", (int)map->minify, LAM_FILTER_COUNT},
                   {"mip", (int)map->mip, LAM_MIP_COUNT},
                   {"channel", map->channel, 4}};
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++)
        if (choices[i].value < 0 || choices[i].value >= choices[i].end)
            return fail(error, LAM_BAD_ARGUMENT, "%s: %s is %d, expected 0 to %d", name, choices[i].name,
                        choices[i].value, choices[i].end - 1);
    float sum = map->scale * 0 + map->offset * 0;
    for (int i = 0; i < 6; i++)
        sum += map->transform[i / 3][i % 3] * 0;
    return sum == 0 || fail(error, LAM_BAD_ARGUMENT, "%s: a number of the map is not finite", name);
}

struct texture_sampler texture_map_sampler(const lam_texture_map *map)
{
    return (struct texture_sampler){map->magnify, map->minify, map->mip, 1};
}

bool texture_map_same_taps(const lam_texture_map *a, const lam_texture_map *b)
{
    const struct texture_level *at = &a->texture->levels[0], *bt = &b->texture->levels[0];
    return at->width == bt->width && at->height == bt->height && a->texcoords == b->texcoords &&
           a->wrap_s == b->wrap_s && a->wrap_t == b->wrap_t && a->magnify == b->magnify && a->minify == b->minify &&
           a->mip == b->mip && memcmp(a->transform, b->transform, sizeof a->transform) == 0;
}

bool texture_map_same(const lam_texture_map *a, const lam_texture_map *b)
{
    return a->texture == b->texture && texture_map_same_taps(a, b);
}

// --- computes bounds of a texture's values.

// The number of texels that are compared together. With three or four channels, the bytes of these texels fill whole
// registers.
enum { TOGETHER = 16, CHANNELS = 4 };

struct byte_ranges {
    uint8_t low[CHANNELS * TOGETHER], high[CHANNELS * TOGETHER];
};

static void extend(struct byte_ranges *r, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        r->low[i] = bytes[i] < r->low[i] ? bytes[i] : r->low[i];
        r->high[i] = bytes[i] > r->high[i] ? bytes[i] : r->high[i];
    }
}

static void ranges_of_bytes(const uint8_t *bytes, size_t texels, size_t channels, uint8_t low[CHANNELS],
                            uint8_t high[CHANNELS])
{
    struct byte_ranges r;
    const size_t step = TOGETHER * channels, all = texels * channels;
    for (size_t i = 0; i < step; i++) {
        r.low[i] = 255;
        r.high[i] = 0;
    }
    size_t at = 0;
    for (; at + step <= all; at += step)
        if (channels == CHANNELS)
            extend(&r, bytes + at, CHANNELS * TOGETHER);
        else
            extend(&r, bytes + at, 3 * TOGETHER);
    extend(&r, bytes + at, all - at);
    for (size_t i = 0; i < step; i++) {
        low[i % channels] = r.low[i] < low[i % channels] ? r.low[i] : low[i % channels];
        high[i % channels] = r.high[i] > high[i % channels] ? r.high[i] : high[i % channels];
    }
}

// Returns the smallest byte of each channel in the low half of the result, and the largest byte of each channel in the
// high half.
static uint64_t ranges_of(const struct lam_texture *texture)
{
    uint64_t *kept = (uint64_t *)(uintptr_t)&texture->ranges;
    uint64_t ranges = __atomic_load_n(kept, __ATOMIC_RELAXED);
    if (ranges)
        return ranges;
    uint8_t low[CHANNELS] = {255, 255, 255, 255}, high[CHANNELS] = {0, 0, 0, texture->channels == 3 ? 255 : 0};
    const struct texture_level *l = &texture->levels[0];
    ranges_of_bytes(texture->bytes, (size_t)l->width * (size_t)l->height, (size_t)texture->channels, low, high);
    for (int c = 0; c < CHANNELS; c++)
        ranges |= (uint64_t)low[c] << 8 * c | (uint64_t)high[c] << (8 * (c + CHANNELS));
    __atomic_store_n(kept, ranges, __ATOMIC_RELAXED);
    return ranges;
}

void texture_map_range(const lam_texture_map *map, float out[2])
{
    const struct lam_texture *texture = map->texture;
    float scale = map->scale != 0 ? map->scale : 1;
    out[0] = -1e30f;
    out[1] = 1e30f;
    if (!texture->bytes)
        return;
    uint64_t ranges = ranges_of(texture) >> 8 * map->channel;
    const float *decode = texture->decode + (map->channel == 3 ? 256 : 0);
    float a = map->offset + scale * decode[ranges & 255];
    float b = map->offset + scale * decode[ranges >> 8 * CHANNELS & 255];
    out[0] = a < b ? a : b;
    out[1] = a < b ? b : a;
}
