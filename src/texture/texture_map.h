// texture_map.h: how a material reads a texture: checks, and values at many points.
#ifndef TEXTURE_MAP_H
#define TEXTURE_MAP_H

#include "texture_levels.h"

// Returns whether a map can be used. `name` begins the sentence.
bool texture_map_check(const lam_texture_map *map, const char *name, lam_error *error);

// Returns whether two maps have the same texels everywhere: they may differ in channel, scale and offset.
bool texture_map_same(const lam_texture_map *a, const lam_texture_map *b);

// Returns whether some texel's alpha is below 1.
static inline bool texture_map_translucent(const lam_texture_map *map)
{
    return map && map->texture && !map->texture->opaque;
}

// Bounds of a map's numbers, as its channel, scale and offset give them, but for rounding; −1e30 and 1e30 where the texture was
// not made of bytes. Found once for a texture, by any number of threads.
void texture_map_range(const lam_texture_map *map, float out[2]);

// `count` points: texture coordinates of the mesh, and their derivatives by the pixel's x and y.
struct texture_points {
    const float *s, *t, *ds_dx, *dt_dx, *ds_dy, *dt_dy;
};

// The texels that points read (texture_taps.h): four of a level, and four of the next where its share is not 0.
enum { TAPS_ROW = 528 }; // points at a time, at most

struct texture_taps {
    int32_t level[TAPS_ROW];
    float next[TAPS_ROW]; // the share of the next level
    struct tap_rows {
        // The first texel of the four counted from the level's, and the steps to the right and down from there.
        int32_t first[TAPS_ROW], across[TAPS_ROW], down[TAPS_ROW];
        float right[TAPS_ROW], lower[TAPS_ROW]; // shares
    } at[2];
};

// Returns whether two maps read the same places of pictures of the same size.
bool texture_map_same_taps(const lam_texture_map *a, const lam_texture_map *b);

// The texels of points, filtered, to four rows: the map's numbers before scale and offset.
void texture_fetch(const struct lam_texture *texture, const struct texture_taps *taps, int count, float *const out[4]);

// The same for points whose footprints are filtered with up to `anisotropy` > 1 probes along the longer axis. `level` gets
// the level of detail of each point.
void texture_map_anisotropic(const lam_texture_map *map, const struct texture_points *points, int count, int anisotropy,
                             float *const out[4], float *level);

// Returns the texel of a map at a point, at level 0 alone.
texel texture_map_base(const lam_texture_map *map, float s, float t);

#endif
