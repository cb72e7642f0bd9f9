// texture_levels.h: the internal structure of lam_texture: a pyramid of levels.
#ifndef TEXTURE_LEVELS_H
#define TEXTURE_LEVELS_H

#include "call_control.h"

#include <lambent/image.h>
#include <lambent/texture.h>

#include <stdint.h>

enum { TEXTURE_SIDE_MAX = 16384, TEXTURE_LEVELS_MAX = 15 };

// A texel of four channels, which are computed together. GCC and Clang compile this type for any instruction set, with
// identical results.
typedef float texel __attribute__((vector_size(16)));
typedef float texel_memory __attribute__((vector_size(16), aligned(4), may_alias));

struct texture_level {
    int width, height;
    const float *floats; // texels of floats, row by row from the top; NULL if `bytes` is used
};

struct lam_texture {
    int references; // accessed atomically
    int level_count;
    lam_texture_values values;
    // Channels per texel; 3 if every alpha is 1. If the texels are floats, it is safe to read one number after the last
    // texel.
    int channels;
    // No texel has an alpha below 1.
    bool opaque;
    // The smallest and the largest byte of level 0 for each channel (texture_map.c); 0 if not computed yet. Accessed
    // atomically.
    uint64_t ranges;
    const char *name; // may be NULL
    // Level 0 of an 8-bit picture.
    const uint8_t *bytes;
    const float *decode; // the 256 values of a byte of red, green and blue; alpha is byte ÷ 255
    struct texture_level levels[TEXTURE_LEVELS_MAX];
    void *storage;
    float *pages; // the large levels; NULL means that all levels follow this struct
    size_t held;  // size of `pages` in bytes
};

// Expands texels of `channels` numbers to four channels.
static inline texel texel_of_floats(const float *at, int channels)
{
    texel t = *(const texel_memory *)at;
    if (channels == 3)
        t[3] = 1;
    return t;
}

static inline texel texel_of_bytes(const uint8_t *at, const float *decode, int channels)
{
    return (texel){decode[at[0]], decode[at[1]], decode[at[2]], channels == 3 ? 1 : decode[256 + at[3]]};
}

// Returns a texel; x and y must be inside the level.
static inline texel texel_at(const struct lam_texture *texture, int level, int x, int y)
{
    const struct texture_level *l = &texture->levels[level];
    size_t at = ((size_t)y * (size_t)l->width + (size_t)x) * (size_t)texture->channels;
    return l->floats ? texel_of_floats(l->floats + at, texture->channels)
                     : texel_of_bytes(texture->bytes + at, texture->decode, texture->channels);
}

// Makes a texture from a decoded picture (LAM_RGB8, LAM_RGBA8, or LAM_RGBA32F with linear values, not premultiplied),
// and becomes the owner of the picture's pixels if the pixels are bytes. The texture's memory counts towards the memory
// limit of `call` (may be NULL). Fails with LAM_LIMIT or LAM_BAD_ARGUMENT; the picture is freed in any case.
struct lam_texture *texture_of_image(lam_image *image, lam_texture_values values, const char *name,
                                     struct call_control *call, lam_error *error);

// Divides the colours of a picture of floats by their alpha.
void texture_unpremultiply(lam_image *image);

// Adds a reference.
struct lam_texture *texture_share(const struct lam_texture *texture);

// Fills levels 1 … level_count − 1 from level 0. The sizes and the memory of these levels are already set.
void mipmaps_make(struct lam_texture *texture);

#endif
