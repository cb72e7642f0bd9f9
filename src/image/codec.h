// codec.h: one picture format: one file, one row in codecs.c.
#ifndef CODEC_H
#define CODEC_H

#include "pool.h"

#include <lambent/image.h>

struct codec {
    const char *name;  // "png"; also the file-name ending, without its dot
    const char *title; // for messages: "PNG"
    lam_pixel_format pixels;

    // NULL: this format is only read. Encodes a picture of valid size and pixel format into memory from malloc.
    // `params` is never NULL; `pool` may be, and does not change the bytes.
    bool (*write)(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                  lam_error *error);

    // Whether a file that starts with these bytes is of this format.
    bool (*probe)(const uint8_t *bytes, size_t size);

    // Decodes a file into `image`, which is empty; on failure it stays so. `name` stands for the file in messages.
    bool (*read)(const uint8_t *bytes, size_t size, const char *name, lam_image *image, lam_error *error);

    // As read, for a format that can have more than 8 bits a number. For such a file `image` becomes LAM_RGBA32F with
    // the file's numbers, 0…1, neither decoded nor premultiplied, and *wide becomes true. NULL: read keeps all bits.
    bool (*read_wide)(const uint8_t *bytes, size_t size, const char *name, lam_image *image, bool *wide,
                      lam_error *error);

    // Whether the first bytes of a file of this format (CODEC_HEAD of them or the whole file) say that
    // Lambent wrote it. NULL: the format cannot say it.
    bool (*ours)(const uint8_t *bytes, size_t size);
};

enum { CODEC_HEAD = 512 };

extern const struct codec codec_png, codec_ppm, codec_pfm, codec_exr, codec_jpeg, codec_hdr;

// Converts a picture from a codec to LAM_RGBA32F, linear and premultiplied. `wide`: as read_wide set it.
bool image_linearize(lam_image *image, bool wide, lam_color_mode color, lam_error *error);

// The two halves of codec_png.
bool png_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
               lam_error *error);
bool png_read(const uint8_t *bytes, size_t size, const char *name, lam_image *image, lam_error *error);

#endif
