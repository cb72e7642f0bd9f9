// codec.h: the interface of a picture format. A new format needs a file with a struct codec, and its name in CODECS.
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
    struct call_control *call; // the call whose limits apply to decoding; may be NULL
};

struct codec {
    const char *name;  // "png"; also the file extension, without its dot
    const char *title; // for messages: "PNG"
    const char *alias; // another file extension, or NULL
    // One line about the values that a file stores, for lists of formats. NULL means that Lambent only reads this
    // format; `write` is then also NULL.
    const char *written;
    lam_pixel_format pixels; // but LAM_RGBA32F for a PNG of single numbers (lam_save_params.single)
    // Whether files of this format have no signature. If so, the format is tried after all others, and is recognised by
    // the file extension.
    bool unmarked;

    // Encodes a picture of valid size and pixel format into memory that is allocated with malloc. `params` is never
    // NULL; `pool` may be NULL, and does not affect the bytes.
    bool (*write)(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                  lam_error *error);

    // Returns whether a file that starts with these bytes has this format.
    bool (*probe)(const uint8_t *bytes, size_t size);

    // Decodes a file into `image`, which is empty and remains empty on failure. Call picture_make to allocate the
    // pixels. Decode one row at a time, and stop if picture_continues returns false.
    bool (*read)(const struct picture_file *file, lam_image *image, lam_error *error);

    // Decodes without loss of precision. If the file has more than 8 bits per channel, `image` becomes LAM_RGBA32F and
    // *wide becomes true. The pixels are then the file's numbers, scaled to 0…1, neither decoded nor premultiplied. If
    // the file has 8 bits and no alpha, `image` becomes LAM_RGB8. If this function is NULL, `read` is used.
    bool (*read_wide)(const struct picture_file *file, lam_image *image, bool *wide, lam_error *error);

    // Returns whether the first bytes of a file of this format (CODEC_HEAD bytes or the whole file) show that Lambent
    // wrote the file. NULL means that the format cannot store this information.
    bool (*ours)(const uint8_t *bytes, size_t size);
};

enum { CODEC_HEAD = 512 };

// The formats, in the order in which Lambent probes files and lists formats. Formats without a signature are last.
// tests/fuzz/meson.build also reads these names.
#define CODECS(X) X(png) X(ppm) X(pfm) X(exr) X(jpeg) X(webp) X(avif) X(hdr) X(bmp) X(tga)

#define CODEC(name) extern const struct codec codec_##name;
CODECS(CODEC)
#undef CODEC
// A format that Lambent only writes: its row has no probe and no read.
extern const struct codec codec_gif;

// Returns the codec of a file that starts with these bytes, or NULL if no format matches. If the bytes match several
// formats, the extension of `name` (may be NULL) selects the format.
const struct codec *codec_of(const uint8_t *bytes, size_t size, const char *name);

// Checks the parameters. Fails with LAM_BAD_ARGUMENT if one of them is invalid.
bool save_params_check(const lam_save_params *params, lam_error *error);

// Returns the thread pool for encoding a picture; NULL means that the calling thread works alone. `threads` is as in
// lam_save_params.
struct pool *encoding_pool(const lam_image *image, int threads);

// Checks that a picture of this size may be read. This check is made before memory is allocated for the picture. Fails
// with LAM_LIMIT (lam_control.pixel_limit).
bool picture_size_check(const struct picture_file *file, uint32_t width, uint32_t height, lam_error *error);

// Allocates a picture of a checked size for a codec to fill. The bytes of the picture count towards the memory limit of
// the file's call. Fails with LAM_LIMIT.
bool picture_make(const struct picture_file *file, uint32_t width, uint32_t height, lam_pixel_format format,
                  lam_image *image, lam_error *error);

// Does the same as picture_make, with `more` bytes after the pixels. `more` must be smaller than the number of bytes of
// pixels. The additional bytes do not count towards the memory limit.
bool picture_make_larger(const struct picture_file *file, uint32_t width, uint32_t height, lam_pixel_format format,
                         size_t more, lam_image *image, lam_error *error);

// For libraries that decode a picture in one step, which cannot be stopped, and may crash if memory runs out: checks that
// the picture is not too large for its file, and that `own` bytes can be allocated. Charges them to the call; the caller
// refunds them after decoding. Fails with LAM_LIMIT.
bool picture_step_check(const struct picture_file *file, uint32_t width, uint32_t height, size_t own, lam_error *error);

// Frees a picture; the picture's bytes no longer count towards the memory limit of `call`. `call` may be NULL; an empty
// picture is allowed.
void picture_free(struct call_control *call, lam_image *image);

// Returns whether decoding may continue with row `y`. Fills the error if it may not continue.
static inline bool picture_continues(const struct picture_file *file, int64_t y, lam_error *error)
{
    return y % 16 != 0 || call_should_continue(file->call) || call_error(file->call, error);
}

// Decode a picture of any format. picture_decode_linear also converts the picture to LAM_RGBA32F, linear and
// premultiplied. The bytes of the picture count towards the memory limit of the file's call until picture_free.
bool picture_decode(const struct picture_file *file, lam_image *image, lam_error *error);
// Decodes like read_wide; the result may be LAM_RGB8.
bool picture_decode_wide(const struct picture_file *file, bool *wide, lam_image *image, lam_error *error);
bool picture_decode_linear(const struct picture_file *file, lam_color_mode color, lam_image *image, lam_error *error);

// Converts a picture from a codec to LAM_RGBA32F, linear and premultiplied. `wide` is the result of read_wide. On
// failure the picture is unchanged or empty.
bool picture_linearize(const struct picture_file *file, lam_image *image, bool wide, lam_color_mode color,
                       lam_error *error);

enum { SAVE_COMMENT_MAX = 200 }; // bytes of lam_save_params.comment

// The comment that Lambent writes to its JPEG files.
#define JPEG_REMARK "lambent"

// Returns whether this machine can read AVIF pictures.
bool avif_is_installed(void);

// The functions that write JPEG and PNG. Other files define codec_jpeg and codec_png.
bool jpeg_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                lam_error *error);
bool png_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
               lam_error *error);

#endif
