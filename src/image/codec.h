// codec.h: one picture format: one file, one row in codecs.c.
#ifndef CODEC_H
#define CODEC_H

#include "pool.h"

#include <lambent/image.h>

struct codec {
    const char *name;  // "png"; also the file-name ending, without its dot
    const char *title; // for messages: "PNG"
    lam_pixel_format pixels;

    // NULL: this format is only read. Encodes a picture whose size and pixel format are right into memory from malloc.
    // `params` is never NULL; `pool` may be, and has nothing to do with the bytes.
    bool (*write)(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                  lam_error *error);

    // Whether a file that starts with these bytes is of this format.
    bool (*probe)(const uint8_t *bytes, size_t size);

    // Decodes a file into `image`, which is empty; on failure it stays so. `name` stands for the file in messages.
    bool (*read)(const uint8_t *bytes, size_t size, const char *name, lam_image *image, lam_error *error);

    // As read, for a format that can have more than 8 bits for a number: then `image` becomes LAM_RGBA32F with the
    // numbers as they are in the file, 0…1, neither decoded nor premultiplied, and *wide is true. NULL: read has all
    // bits.
    bool (*read_wide)(const uint8_t *bytes, size_t size, const char *name, lam_image *image, bool *wide,
                      lam_error *error);

    // Whether the first bytes of a file of this format (CODEC_HEAD of them or the whole file) say that
    // Lambent wrote it. NULL: the format has no place for it.
    bool (*ours)(const uint8_t *bytes, size_t size);
};

enum { CODEC_HEAD = 512 };

extern const struct codec codec_png, codec_ppm, codec_pfm, codec_exr, codec_jpeg, codec_hdr;

// Makes a picture as a codec gave it LAM_RGBA32F, linear and premultiplied. `wide`: as read_wide says.
bool image_linearize(lam_image *image, bool wide, lam_color_mode color, lam_error *error);

// Halves of codec_png, each with a file of its own.
bool png_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
               lam_error *error);
bool png_read(const uint8_t *bytes, size_t size, const char *name, lam_image *image, lam_error *error);

#endif
