// texture_levels.h: the inside of lam_texture: a pyramid of levels.
#ifndef TEXTURE_LEVELS_H
#define TEXTURE_LEVELS_H

#include "call_control.h"

#include <lambent/image.h>
#include <lambent/texture.h>

#include <stdint.h>

enum { TEXTURE_SIDE_MAX = 16384, TEXTURE_LEVELS_MAX = 15 };

// Four channels at a time. GCC and Clang compile this for any instruction set, with the same bits.
typedef float texel __attribute__((vector_size(16)));
typedef float texel_memory __attribute__((vector_size(16), aligned(4), may_alias));

struct texture_level {
    int width, height;
    const float *floats; // RGBA, rows from the top; NULL: `bytes`
};

struct lam_texture {
    int references; // accessed atomically
    int level_count;
    lam_texture_values values;
    // No texel has an alpha below 1.
    bool opaque;
    const char *name; // NULL: none
    // Of level 0, where the picture has 8 bits: RGBA.
    const uint8_t *bytes;
    const float *decode; // 256 values of a byte of red, green and blue; alpha is byte ÷ 255
    struct texture_level levels[TEXTURE_LEVELS_MAX];
    void *storage;
    float *pages; // of large levels; NULL: they lie behind this structure
    size_t held;  // of those pages
};

// A texel; x and y are inside.
static inline texel texel_at(const struct lam_texture *texture, int level, int x, int y)
{
    const struct texture_level *l = &texture->levels[level];
    size_t at = ((size_t)y * (size_t)l->width + (size_t)x) * 4;
    if (l->floats)
        return *(const texel_memory *)(l->floats + at);
    const uint8_t *byte = texture->bytes + at;
    return (texel){texture->decode[byte[0]], texture->decode[byte[1]], texture->decode[byte[2]],
                   texture->decode[256 + byte[3]]};
}

// Makes a texture of a decoded picture (LAM_RGBA8, or LAM_RGBA32F whose numbers are linear and not premultiplied), whose
// pixels it takes over where they are bytes. Its memory is charged to `call`, which may be NULL. NULL: LAM_LIMIT,
// LAM_BAD_ARGUMENT; the picture is freed in any case.
struct lam_texture *texture_of_image(lam_image *image, lam_texture_values values, const char *name,
                                     struct call_control *call, lam_error *error);

// The same from the bytes of a picture's file. `color` LAM_COLOR_RAW: colours are taken as they are.
struct lam_texture *texture_decode(const void *bytes, size_t size, const char *name, lam_texture_values values,
                                   struct call_control *call, lam_error *error);

// Adds a reference.
struct lam_texture *texture_share(const struct lam_texture *texture);

// Fills levels 1 … level_count − 1 from level 0. Their sizes and memory are set.
void mipmaps_make(struct lam_texture *texture);

#endif
