// texture_map.h: how a material reads a texture: checks, and values at many points.
#ifndef TEXTURE_MAP_H
#define TEXTURE_MAP_H

#include "texture_levels.h"

// Whether a map can be used. `name` begins the sentence.
bool texture_map_check(const lam_texture_map *map, const char *name, lam_error *error);

// Whether two maps have the same texels everywhere: they may differ in channel, scale and offset.
bool texture_map_same(const lam_texture_map *a, const lam_texture_map *b);

// Whether some texel's alpha is below 1.
static inline bool texture_map_translucent(const lam_texture_map *map)
{
    return map && map->texture && !map->texture->opaque;
}

// `count` points: texture coordinates of the mesh, and their derivatives by the pixel's x and y.
struct texture_points {
    const float *s, *t, *ds_dx, *dt_dx, *ds_dy, *dt_dy;
};

// The texels of a map at points, filtered, before scale and offset, to four rows. `anisotropy` ≥ 1: the most probes along
// the longer axis of a pixel's footprint. `level` (may be NULL) gets the level of detail of each point.
void texture_map_texels(const lam_texture_map *map, const struct texture_points *points, int count, int anisotropy,
                        float *const out[4], float *level);

// The same at level 0 alone, without derivatives.
texel texture_map_base(const lam_texture_map *map, float s, float t);

#endif
