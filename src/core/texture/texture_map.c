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
