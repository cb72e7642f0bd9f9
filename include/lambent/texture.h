// lambent/texture.h: textures, and how a material reads them.
#ifndef LAMBENT_TEXTURE_H
#define LAMBENT_TEXTURE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

struct lam_image;

// A picture with its mipmaps: RGBA, linear numbers, filtered as floats. A texture is immutable, so any number of
// materials, scenes and threads may share it. Level 0 is the picture. Each further level has half the width and height,
// rounded down; its texels are the averages of the texels that they cover, in linear light and not rounded.
typedef struct lam_texture lam_texture;

// The meaning of a picture's numbers. Float pictures are always linear.
typedef enum lam_texture_values {
    // Red, green and blue are sRGB-encoded colours, which are decoded before averaging.
    LAM_TEXTURE_COLOR = 0,
    LAM_TEXTURE_NUMBERS, // used without conversion: normals, roughness
} lam_texture_values;

// Makes a texture from a picture, which is copied, of up to 16384 pixels on a side. Reports use `name`, which may be
// NULL. The caller frees it with lam_texture_free. Returns NULL on failure: LAM_BAD_ARGUMENT (the picture; a number
// that is not finite), LAM_LIMIT (size, memory).
LAM_API lam_texture *lam_texture_make(const struct lam_image *image, lam_texture_values values, const char *name,
                                      lam_error *error);

// Frees a texture. Scenes whose materials use the texture keep it. NULL is allowed.
LAM_API void lam_texture_free(lam_texture *texture);

// These functions return the width and the height of a level in texels, or 0 if the level is out of range. Level 0 is
// the picture.
LAM_API int lam_texture_width(const lam_texture *texture, int level);
LAM_API int lam_texture_height(const lam_texture *texture, int level);
LAM_API int lam_texture_levels(const lam_texture *texture);
LAM_API lam_texture_values lam_texture_values_of(const lam_texture *texture);
LAM_API const char *lam_texture_name(const lam_texture *texture); // NULL: unnamed
// Returns the memory of all levels in bytes.
LAM_API uint64_t lam_texture_memory(const lam_texture *texture);

// The treatment of texture coordinates beyond the picture's edges.
typedef enum lam_wrap {
    LAM_WRAP_REPEAT = 0, // repeats the picture
    LAM_WRAP_CLAMP,      // repeats the texels of the edge
    LAM_WRAP_MIRROR,     // repeats the picture, mirrored every other time
    LAM_WRAP_COUNT
} lam_wrap;

// The filter of a texture lookup.
typedef enum lam_filter {
    LAM_FILTER_LINEAR = 0, // the four nearest texels, weighted by distance
    LAM_FILTER_NEAREST,    // the texel that contains the point
    LAM_FILTER_COUNT
} lam_filter;

// The mipmap levels used for minification.
typedef enum lam_mip {
    LAM_MIP_LINEAR = 0, // two levels, interpolated (trilinear)
    LAM_MIP_NEAREST,    // the level of the nearest size
    LAM_MIP_NONE,       // level 0 only
    LAM_MIP_COUNT
} lam_mip;

// A texture with the settings of its lookup. All settings have the default 0. The value of a map is
//  offset + scale · texel(transform · (s, t, 1))
// for each channel (normal maps: docs/textures.md).
typedef struct lam_texture_map {
    const lam_texture *texture; // required
    int texcoords;              // set of the mesh's texture coordinates, 0 or 1
    lam_wrap wrap_s, wrap_t;    // in each direction
    lam_filter magnify, minify; // filters for magnification and minification
    lam_mip mip;                // mipmap levels for minification
    // The channel of a map with single numbers (shininess, opacity, metallic, roughness, occlusion, bump): 0 red … 3
    // alpha.
    int channel;
    // Converts the mesh's texture coordinates to coordinates in the picture: (0, 0) is its upper left corner, and (1,
    // 1) its lower right corner. All zero: the identity.
    float transform[2][3];
    // Multiplies the texel. 0: 1. Normal maps: multiplies x and y. Bump maps: the height of the value 1, in texels of
    // level 0.
    float scale;
    float offset; // added to the scaled texel
    LAM_RESERVED(16);
} lam_texture_map;

// Returns the value of a texture at a point (s, t), filtered as `map` says, at level of detail `level` (log2 of texels
// of level 0 per pixel; below 0 means magnification). Returns zero if `map->texture` is NULL.
LAM_API lam_rgba lam_texture_sample(const lam_texture_map *map, double s, double t, double level);

#ifdef __cplusplus
}
#endif
#endif
