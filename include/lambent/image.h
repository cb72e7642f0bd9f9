// lambent/image.h: pictures: pixels in memory, files, comparison.
#ifndef LAMBENT_IMAGE_H
#define LAMBENT_IMAGE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lam_pixel_format {
    LAM_RGBA8 = 0,   // 4 bytes a pixel, sRGB-encoded (or raw numbers), colour not premultiplied
    LAM_RGBA32F = 1, // 4 floats a pixel, linear, premultiplied by alpha
} lam_pixel_format;

// A picture. Rows run top to bottom, without padding: pixel (x, y) starts at pixels + (y·width + x)·bytes,
// with 4 bytes a pixel for LAM_RGBA8 and 16 for LAM_RGBA32F. Zero-initialise before lam_image_make.
typedef struct lam_image {
    int width, height; // pixels, 1..65535
    lam_pixel_format format;
    void *pixels; // owned; freed by lam_image_free
} lam_image;

// Allocates a picture of width×height pixels, contents undefined. The caller frees it with lam_image_free.
LAM_API bool lam_image_make(lam_image *image, int width, int height, lam_pixel_format format, lam_error *error);

// Frees the pixels and zeroes the struct. NULL and a zeroed struct are fine.
LAM_API void lam_image_free(lam_image *image);

// How much work is put into making a PNG file small. Every reader reads either; the picture is the same.
typedef enum lam_compress {
    LAM_COMPRESS_FAST, // the default: some milliseconds for a million pixels
    LAM_COMPRESS_BEST, // about a third smaller, a hundred times slower
} lam_compress;

// How a picture is written. All zero is the plain default.
typedef struct lam_save_params {
    const lam_control *control; // cancel flag and time limit, checked while encoding; NULL: none
    // Formats without alpha (PPM) hold the picture over this colour, linear. Default black.
    lam_rgb background;
    int threads; // threads to encode with; 0: one for each processor. The bytes do not depend on it.
    bool raw;    // the numbers are not sRGB-encoded: PNG gets no sRGB chunk, PPM is composed without conversion
    lam_compress compress; // of PNG; other formats take no notice
} lam_save_params;

// A block of bytes that the caller frees with lam_bytes_free.
typedef struct lam_bytes {
    void *data;
    size_t size;
} lam_bytes;

LAM_API void lam_bytes_free(lam_bytes *bytes);

// Encodes a picture. `format` is "png" (from LAM_RGBA8), "ppm" (from LAM_RGBA8) or "pfm" (from LAM_RGBA32F, RGB,
// linear, bottom row first) or "exr" (from LAM_RGBA32F, 32-bit floats; LAM_UNSUPPORTED where OpenEXR is not). The same
// picture always gives the same bytes. `params` may be NULL. Errors: LAM_BAD_ARGUMENT (pixel format does not fit),
// LAM_UNSUPPORTED (no such format), LAM_LIMIT.
LAM_API bool lam_image_encode(const lam_image *image, const char *format, const lam_save_params *params, lam_bytes *out,
                              lam_error *error);

// Encodes and writes to `path`, the format taken from the name's end. The file appears whole or not at all:
// it is written beside the path under another name and then renamed. Errors as above, LAM_CANNOT_WRITE.
LAM_API bool lam_image_save(const lam_image *image, const char *path, const lam_save_params *params, lam_error *error);

// A layer of an EXR picture.
typedef struct lam_layer {
    const char *name;       // "diffuse": channels diffuse.R, …; NULL or "": the picture itself, R, …
    const lam_image *image; // LAM_RGBA32F, of the same size as the others
    // a letter for each number of a pixel that is written, in their order: "XYZ"; NULL: "RGB", of the picture
    // itself "RGBA"
    const char *channels;
} lam_layer;

// Encodes, and writes to `path` as lam_image_save does, one EXR picture with all layers: 32-bit floats, ZIP. The same
// layers give the same bytes with the same OpenEXR library. Errors: LAM_BAD_ARGUMENT (sizes, formats, channels of the
// same name), LAM_UNSUPPORTED (OpenEXR is not in this build, or not installed), LAM_LIMIT, LAM_CANNOT_WRITE.
LAM_API bool lam_image_encode_layers(const lam_layer *layers, int count, lam_bytes *out, lam_error *error);
LAM_API bool lam_image_save_layers(const lam_layer *layers, int count, const char *path, lam_error *error);

// The pixel format that a file name asks for: LAM_RGBA32F for .pfm and .exr, LAM_RGBA8 for .png and .ppm.
// LAM_UNSUPPORTED for another ending, naming those that can be written.
LAM_API bool lam_image_format_for(const char *path, lam_pixel_format *format, lam_error *error);

// Reads a picture: PNG, JPEG (not CMYK) and binary PPM into LAM_RGBA8 (16 bits are cut to 8, grey and palettes become
// RGB), PFM, EXR (scanlines; the first part) and Radiance (.hdr) into LAM_RGBA32F, with alpha 1 where the file has
// none. Content decides the format. `image` may hold anything before; it is
// not freed, and is zeroed on failure. Errors: LAM_CANNOT_READ, LAM_UNSUPPORTED, LAM_LIMIT (a side over 65535, memory).
LAM_API bool lam_image_load(lam_image *image, const char *path, lam_error *error);

// Reads a picture of any of these formats into LAM_RGBA32F, linear and premultiplied. The numbers of PNG (all 16 bits
// where it has them), JPEG and PPM are decoded from sRGB, or taken as they are, 0…1, with LAM_COLOR_RAW; PFM and
// Radiance are linear already. Otherwise as lam_image_load.
LAM_API bool lam_image_load_linear(lam_image *image, const char *path, lam_color_mode color, lam_error *error);

// Whether the file at `path` says that Lambent wrote it: PNG by its text "Software: lambent", PPM by the comment
// "# lambent" in its second line. False for PFM, which has no place to say so, and wherever it cannot be told (no such
// file, not a regular file, not readable). Looks at the file's beginning only.
LAM_API bool lam_image_is_from_lambent(const char *path);

// How far two pictures of the same size and format are apart, over all channels; a channel's unit is 1 = full
// range (LAM_RGBA8: 255 steps). Where one picture has a number and the other has NaN or another infinity, they are
// infinitely far apart.
typedef struct lam_difference {
    double maximum, mean, rmse;
    double psnr_db; // 20·log10(1 / rmse); infinity for equal pictures, −infinity for infinitely different ones
    double share_over_1, share_over_2; // share of pixels, 0..1, with a channel off by more than 1/255, 2/255
} lam_difference;

// LAM_BAD_ARGUMENT when sizes or formats differ.
LAM_API bool lam_image_compare(const lam_image *a, const lam_image *b, lam_difference *difference, lam_error *error);

// A picture of where two pictures of the same size and format are apart: each colour channel is `gain` times the larger
// of the channel's own difference and alpha's, and alpha is 1. Black is equal. LAM_RGBA8 ends at 255; LAM_RGBA32F goes
// on, and is infinite where lam_image_compare calls two numbers infinitely far apart. `gain` ≥ 0 and finite.
// `difference` is made by the call (what it held is not freed) and freed by the caller. Saved as PNG its numbers are
// raw (lam_save_params). LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_image_difference(const lam_image *a, const lam_image *b, float gain, lam_image *difference,
                                  lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
