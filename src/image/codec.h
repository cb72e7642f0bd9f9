// codec.h: the interface of a picture format. A new format is a file with a struct codec, and its name in CODECS.
#ifndef CODEC_H
#define CODEC_H

#include "call_control.h"
#include "pool.h"

#include <lambent/image.h>

// A picture's file, in memory.
struct picture_file {
    const uint8_t *bytes;
    size_t size;
    const char *name;          // the file's name in messages
    struct call_control *call; // checked while decoding, and charged for the pixels; may be NULL
};

struct codec {
    const char *name;  // "png"; also the file-name ending, without its dot
    const char *title; // for messages: "PNG"
    const char *alias; // another file-name ending; NULL: none
    // One line for lists: the stored numbers. NULL: this format is only read, and `write` is NULL too.
    const char *written;
    lam_pixel_format pixels;
    // Its files begin with no signature: it is tried after all others, and by the ending of a file's name.
    bool unmarked;

    // Encodes a picture of valid size and pixel format into memory from malloc.
    // `params` is never NULL; `pool` may be, and does not change the bytes.
    bool (*write)(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                  lam_error *error);

    // Whether a file that starts with these bytes is of this format.
    bool (*probe)(const uint8_t *bytes, size_t size);

    // Decodes a file into `image`, which is empty; on failure it stays so. The pixels are from picture_make, and rows are
    // decoded one by one under picture_continues.
    bool (*read)(const struct picture_file *file, lam_image *image, lam_error *error);

    // As read, but as the file has it. More than 8 bits a number: `image` becomes LAM_RGBA32F with the file's numbers, 0…1,
    // neither decoded nor premultiplied, and *wide becomes true. 8 bits without alpha: LAM_RGB8. NULL: read does that.
    bool (*read_wide)(const struct picture_file *file, lam_image *image, bool *wide, lam_error *error);

    // Whether the first bytes of a file of this format (CODEC_HEAD of them or the whole file) say that
    // Lambent wrote it. NULL: the format cannot say it.
    bool (*ours)(const uint8_t *bytes, size_t size);
};

enum { CODEC_HEAD = 512 };

// The formats, in the order in which files are tried and lists name them; those whose files begin with no signature last.
// tests/fuzz/meson.build reads these names too.
#define CODECS(X) X(png) X(ppm) X(pfm) X(exr) X(jpeg) X(webp) X(hdr) X(bmp) X(tga)

#define CODEC(name) extern const struct codec codec_##name;
CODECS(CODEC)
#undef CODEC

// Returns the codec of a file that starts with these bytes, or NULL if there is none. `name` (may be NULL): where the
// bytes do not tell, the ending of this file name does.
const struct codec *codec_of(const uint8_t *bytes, size_t size, const char *name);

// Fails with LAM_BAD_ARGUMENT.
bool save_params_check(const lam_save_params *params, lam_error *error);

// Returns the threads that encode a picture; NULL: this thread alone. `threads` as in lam_save_params.
struct pool *encoding_pool(const lam_image *image, int threads);

// Returns whether a header's size can be read; no memory is taken for others. LAM_LIMIT (lam_control.pixel_limit).
bool picture_size_check(const struct picture_file *file, uint32_t width, uint32_t height, lam_error *error);

// Makes the picture that a codec fills, of a size that was checked. Its bytes are charged to the file's call. LAM_LIMIT.
bool picture_make(const struct picture_file *file, uint32_t width, uint32_t height, lam_pixel_format format,
                  lam_image *image, lam_error *error);

// The same with more bytes behind the pixels, fewer than a row has for each row; they are not charged.
bool picture_make_larger(const struct picture_file *file, uint32_t width, uint32_t height, lam_pixel_format format,
                         size_t more, lam_image *image, lam_error *error);

// Frees a picture and refunds its bytes. `call` may be NULL; an empty picture is fine.
void picture_free(struct call_control *call, lam_image *image);

// Returns whether decoding continues with row `y`, or false and fills the error.
static inline bool picture_continues(const struct picture_file *file, int64_t y, lam_error *error)
{
    return y % 16 != 0 || call_should_continue(file->call) || call_error(file->call, error);
}

// Decodes a picture of any format; with `linear` to LAM_RGBA32F, linear and premultiplied. Its bytes stay charged to the
// file's call (picture_free).
bool picture_decode(const struct picture_file *file, lam_image *image, lam_error *error);
// As read_wide gives it: also LAM_RGB8.
bool picture_decode_wide(const struct picture_file *file, bool *wide, lam_image *image, lam_error *error);
bool picture_decode_linear(const struct picture_file *file, lam_color_mode color, lam_image *image, lam_error *error);

// Converts a picture from a codec to LAM_RGBA32F, linear and premultiplied. `wide`: as read_wide set it. On failure the
// picture is as it was or empty.
bool picture_linearize(const struct picture_file *file, lam_image *image, bool wide, lam_color_mode color,
                       lam_error *error);

// Our own mark in a JPEG file.
#define JPEG_REMARK "lambent"

// The halves of codec_jpeg and codec_png that write.
bool jpeg_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                lam_error *error);
bool png_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
               lam_error *error);

#endif
