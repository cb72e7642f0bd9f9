// texture_batch.h: decodes the pictures of a model, each content once, in parallel.
#ifndef TEXTURE_BATCH_H
#define TEXTURE_BATCH_H

#include "pool.h"
#include "texture_levels.h"

// Makes a texture from the bytes of a picture file. With LAM_COLOR_RAW as `color`, colours are used without conversion.
struct lam_texture *texture_decode(const void *bytes, size_t size, const char *name, lam_texture_values values,
                                   struct call_control *call, lam_error *error);

// Returns whether a model may be loaded without a texture if texture_decode failed with this error. If not, loading the
// model fails.
bool texture_is_optional(const lam_error *error);

// A picture file that a model uses, and the texture that is made from it.
struct texture_source {
    const uint8_t *bytes;
    size_t size;
    const char *name; // for messages
    lam_texture_values values;
    struct texture_source *first; // the first source of the same contents, whose error holds for this source; else NULL
    struct lam_texture *texture;  // NULL if the picture could not be read; the caller frees it
    lam_error error;
};

// Compares two sources; returns 0 if they make the same texture.
int texture_source_order(const struct texture_source *a, const struct texture_source *b);

// Decodes the pictures. The result does not depend on the number of threads: if the pictures exceed a limit when they
// are decoded at the same time, they are decoded again in the file's order, which is the order of their addresses. If
// the model cannot be loaded (texture_is_optional), the first error in this order is set, and the sources after it are
// not decoded. Changes the order of `list`.
void textures_decode(struct texture_source **list, size_t count, struct pool *pool, struct call_control *call);

#endif
