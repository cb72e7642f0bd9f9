// lambent/texture.h: pictures laid over surfaces, and how a material reads them.
#ifndef LAMBENT_TEXTURE_H
#define LAMBENT_TEXTURE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

struct lam_image;

// A picture with its mipmaps: RGBA, linear numbers, filtered as floats. It never changes, so any number of materials,
// scenes and threads may share it. Level 0 is the picture; each next one has half the sides, rounded down, and texels that
// are the average of the texels above that they cover, in linear light and not rounded.
typedef struct lam_texture lam_texture;

// The meaning of a picture's numbers. Pictures of floats are linear in any case.
typedef enum lam_texture_values {
    // Red, green and blue are sRGB-encoded colours, decoded before anything is averaged.
    LAM_TEXTURE_COLOR = 0,
    LAM_TEXTURE_NUMBERS, // taken as they are: normals, roughness
} lam_texture_values;

// Makes a texture of a picture, which is copied: up to 16384 pixels on a side. Reports use `name` for it, or NULL if
// there is none. The caller frees it with lam_texture_free. Returns NULL on failure: LAM_BAD_ARGUMENT (the picture; a
// number that is not finite), LAM_LIMIT (size, memory).
LAM_API lam_texture *lam_texture_make(const struct lam_image *image, lam_texture_values values, const char *name,
                                      lam_error *error);

// Frees a texture; scenes whose materials name it keep it. NULL is fine.
LAM_API void lam_texture_free(lam_texture *texture);

// Size of a level in texels; 0 out of range. Level 0 is the picture.
LAM_API int lam_texture_width(const lam_texture *texture, int level);
LAM_API int lam_texture_height(const lam_texture *texture, int level);
LAM_API int lam_texture_levels(const lam_texture *texture);
LAM_API lam_texture_values lam_texture_values_of(const lam_texture *texture);
LAM_API const char *lam_texture_name(const lam_texture *texture); // NULL: none
// Bytes of memory of all levels.
LAM_API uint64_t lam_texture_memory(const lam_texture *texture);

// The texels beyond the picture's edges.
typedef enum lam_wrap {
    LAM_WRAP_REPEAT = 0, // the picture again
    LAM_WRAP_CLAMP,      // the texels of the edge
    LAM_WRAP_MIRROR,     // the picture, mirrored every other time
    LAM_WRAP_COUNT
} lam_wrap;

// How texels make a value.
typedef enum lam_filter {
    LAM_FILTER_LINEAR = 0, // the four around the point, weighted by their nearness
    LAM_FILTER_NEAREST,    // the texel that contains the point
    LAM_FILTER_COUNT
} lam_filter;

// Which mipmap levels make a value where the picture is made smaller.
typedef enum lam_mip {
    LAM_MIP_LINEAR = 0, // two, weighted (trilinear)
    LAM_MIP_NEAREST,    // the one of the nearest size
    LAM_MIP_NONE,       // level 0
    LAM_MIP_COUNT
} lam_mip;

// A texture as a material reads it. All zero but for `texture`: the usual. The value of a map is
//   offset + scale · texel(transform · (s, t, 1))
// for each channel (normal maps: docs/textures.md).
typedef struct lam_texture_map {
    const lam_texture *texture; // required
    int texcoords;              // set of the mesh's texture coordinates, 0 or 1
    lam_wrap wrap_s, wrap_t;    // beyond the picture's edges, each way
    lam_filter magnify, minify; // where the picture is made larger, smaller
    lam_mip mip;                // if it is minified
    // The channel of a map of single numbers (shininess, opacity, metallic, roughness, occlusion, bump): 0 red … 3 alpha.
    int channel;
    // From the mesh's texture coordinates to the picture's, whose (0, 0) is the upper left corner and (1, 1) the lower
    // right one. All zero: taken as they are.
    float transform[2][3];
    // Multiplies the texel. 0: 1. Of a normal map: its x and y. Of a bump map: the height of its 1, in texels of level 0.
    float scale;
    float offset; // added to the scaled texel
    LAM_RESERVED(16);
} lam_texture_map;

// The value of a texture at a point (s, t), filtered as `map` says, at level of detail `level` (log2 of texels of level 0 to
// a pixel; below 0 the picture is made larger). `map->texture` NULL: zero.
LAM_API lam_rgba lam_texture_sample(const lam_texture_map *map, double s, double t, double level);

#ifdef __cplusplus
}
#endif
#endif
