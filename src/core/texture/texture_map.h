// texture_map.h: checks a material's maps, and looks up their values at many points.
#ifndef TEXTURE_MAP_H
#define TEXTURE_MAP_H

#include "texture_levels.h"

// Checks whether a map can be used. The error message begins with `name`.
bool texture_map_check(const lam_texture_map *map, const char *name, lam_error *error);

// Returns whether two maps use the same texel everywhere. The channel, scale and offset of the maps may differ.
bool texture_map_same(const lam_texture_map *a, const lam_texture_map *b);

// Returns whether some texel's alpha is below 1.
static inline bool texture_map_translucent(const lam_texture_map *map)
{
    return map && map->texture && !map->texture->opaque;
}

// Gets approximate bounds of a map's values after channel, scale and offset are applied; rounding makes the bounds
// inexact. The bounds are −1e30 and 1e30 if the texture was not made from bytes. Any thread may call this function; the
// bounds of a texture are computed once.
void texture_map_range(const lam_texture_map *map, float out[2]);

// The texture coordinates of `count` points in the mesh, and their derivatives with respect to the pixel's x and y.
struct texture_points {
    const float *s, *t, *ds_dx, *dt_dx, *ds_dy, *dt_dy;
};

// How a map's texels are filtered: the filters of the map, or those that the frame's settings select instead.
struct texture_sampler {
    lam_filter magnify, minify;
    lam_mip mip;
    int probes; // the maximum number of probes along the longer axis of a footprint, 1..16
};

// The filters of the map itself, with one probe.
struct texture_sampler texture_map_sampler(const lam_texture_map *map);

// The texels that points use (texture_taps.h): four of a level, and four of the next level if its weight is not 0.
enum { TAPS_ROW = 528 }; // the maximum number of points at a time

struct texture_taps {
    // How many probes cover each point's footprint: r (docs/textures.md). Above 1, the other rows do not apply.
    float probes[TAPS_ROW];
    int32_t level[TAPS_ROW];
    float next[TAPS_ROW]; // the weight of the next level
    struct tap_rows {
        // The index of the first of the four texels in its level, and the steps to its right and lower neighbours.
        int32_t first[TAPS_ROW], across[TAPS_ROW], down[TAPS_ROW];
        float right[TAPS_ROW], lower[TAPS_ROW]; // weights of the right and lower texels
    } at[2];
};

// Returns whether two maps use the same positions in textures of the same size.
bool texture_map_same_taps(const lam_texture_map *a, const lam_texture_map *b);

// Fetches the filtered texels of points with one probe into four rows: the map's values before scale and offset.
void texture_fetch(const struct lam_texture *texture, const struct texture_taps *taps, int count, float *const out[4]);

// Returns the texel of a map at a point, using only level 0.
texel texture_map_base(const lam_texture_map *map, float s, float t);

#endif
