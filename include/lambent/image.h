// lambent/image.h: pictures: pixels in memory, files, comparison.
#ifndef LAMBENT_IMAGE_H
#define LAMBENT_IMAGE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// 8-bit formats store sRGB-encoded (or raw) numbers; float formats store linear numbers. RGBA8 and BGRA8 are not
// premultiplied by alpha, RGBA32F is premultiplied. Formats without alpha are opaque: a frame is drawn over its
// background, and the background over black. If a picture without alpha is converted to another 8-bit format, alpha is
// 255.
typedef enum lam_pixel_format {
    LAM_RGBA8 = 0,   // 4 bytes per pixel
    LAM_RGBA32F = 1, // 4 floats per pixel
    LAM_BGRA8,       // 4 bytes per pixel, blue first
    LAM_RGB8,        // 3 bytes per pixel
    // 1 byte per pixel: the luminance of the RGB8 picture (BT.709: 0.2126 R + 0.7152 G + 0.0722 B of its linear
    // light, encoded again). Raw numbers and outputs of surface properties (lam_output) are weighted without
    // conversion.
    LAM_GREY8,
    LAM_RGB32F, // 3 floats per pixel
} lam_pixel_format;

// A picture. Row 0 is the top row: pixel (x, y) starts at (char *)pixels + y·stride + x·(bytes per pixel of the
// format). Every function of this library that accepts a picture accepts all formats and strides unless its comment
// says otherwise. The pixels belong to the library (lam_image_make, lam_image_load: `owned` is set) or to the caller:
//    lam_image window = {.width = 800, .height = 600, .format = LAM_BGRA8, .pixels = memory, .stride = pitch};
//
typedef struct lam_image {
    int width, height;       // pixels, 1..65535
    lam_pixel_format format; // determines the bytes per pixel
    // true: lam_image_free frees `pixels`. false: the caller owns them, and they are never freed here.
    bool owned;
    // Set by lam_image_load: the file stores floats without alpha (PFM, HDR, EXR without A); alpha is 1 everywhere.
    bool no_alpha;
    void *pixels; // float formats: aligned to 4 bytes
    // Bytes from one row to the next lower row. 0: rows without padding; negative: bottom row first.
    ptrdiff_t stride;
    LAM_RESERVED(8);
} lam_image;

// Allocates a picture of width×height pixels without padding and with undefined contents. The caller frees it with
// lam_image_free. Errors: LAM_BAD_ARGUMENT, LAM_LIMIT (a side over 65535, memory).
LAM_API bool lam_image_make(lam_image *image, int width, int height, lam_pixel_format format, lam_error *error);

// Frees the pixels if the picture owns them, and zeroes the struct. NULL and a zeroed struct are allowed.
LAM_API void lam_image_free(lam_image *image);

// The compression of PNG files. The pixels are identical.
typedef enum lam_compress {
    // The default: a few milliseconds for a million pixels. The bytes depend only on the picture.
    LAM_COMPRESS_FAST,
    // About a third smaller and a hundred times slower than FAST. Uses libdeflate, which is loaded on demand
    // (LAM_UNSUPPORTED if it is not installed); the bytes depend on its version.
    LAM_COMPRESS_BEST,
} lam_compress;

// Parameters of writing a picture. All zero: the defaults.
typedef struct lam_save_params {
    // Cancel flag and time limit, checked while encoding. NULL: none.
    const lam_control *control;
    // Formats without alpha (PPM, JPEG) store the picture over this linear colour. Default: black.
    lam_rgb background;
    // Number of threads that encode; 0: one for each processor. The bytes do not depend on this number.
    int threads;
    // The numbers are not sRGB-encoded: PNG files contain no sRGB chunk, and PPM and JPEG are composited without
    // conversion.
    bool raw;
    lam_compress compress; // of PNG; ignored for other formats
    // The quality of lossy formats, 1 to 100; other formats ignore it. JPEG: 0 means 90; below 90, colours are stored
    // at half the resolution (4:2:0). WebP: 0 and 100 are lossless.
    int64_t quality;
    // true: lam_image_save returns after the file and its name are on disk (fsync of both), so that a power failure
    // leaves either the old file or the new one. false: the system writes them later, within seconds.
    bool durable;
    // Stores one number for each pixel, the first (red): PFM and EXR (32 bits, channel Z) with one channel; a PNG, which
    // is then made from floats, as 16-bit grey with the number rounded and limited to 0…65535. Other formats ignore it.
    bool single;
    // A text about the picture, at most 200 printable characters of ASCII, which PNG files store as their comment; other
    // formats ignore it. Owned by the caller. NULL: none.
    const char *comment;
    LAM_RESERVED(5);
} lam_save_params;

// A block of bytes that the caller frees with lam_bytes_free.
typedef struct lam_bytes {
    void *data;  // allocated by malloc; NULL: empty
    size_t size; // bytes
} lam_bytes;

// Frees the block and zeroes the struct. NULL and a zeroed struct are allowed.
LAM_API void lam_bytes_free(lam_bytes *bytes);

// Writes a file completely or not at all, as lam_image_save does. Errors: LAM_BAD_ARGUMENT, LAM_CANNOT_WRITE.
LAM_API bool lam_bytes_save(const lam_bytes *bytes, const char *path, lam_error *error);
// Does the same, and returns after the file is on disk, as with lam_save_params.durable.
LAM_API bool lam_bytes_save_durably(const lam_bytes *bytes, const char *path, lam_error *error);

// Encodes a picture. `format` is "png", "ppm", "jpg" ("jpeg") or "webp" (from 8-bit formats), "pfm" (from floats; RGB,
// linear, bottom row first) or "exr" (from floats; 32 bits). "webp" and "exr" fail with LAM_UNSUPPORTED if libwebp or
// OpenEXR is missing. The same picture always gives the same bytes; for "jpg", "webp" and "exr" they depend on the
// version of the library. WebP allows at most 16383 pixels on a side (LAM_LIMIT). `params` may be NULL. Errors:
// LAM_BAD_ARGUMENT (an 8-bit picture for a float format, or vice versa), LAM_UNSUPPORTED (no such format), LAM_LIMIT.
LAM_API bool lam_image_encode(const lam_image *image, const char *format, const lam_save_params *params, lam_bytes *out,
                              lam_error *error);

// Encodes a picture and writes it to `path`, whose extension selects the format. The file appears completely or not at
// all, and no temporary file remains, even if a signal ends the process during the call (including SIGKILL, if the file
// system supports O_TMPFILE). Errors: as above, and LAM_CANNOT_WRITE.
LAM_API bool lam_image_save(const lam_image *image, const char *path, const lam_save_params *params, lam_error *error);

// A layer of an EXR picture.
typedef struct lam_layer {
    // "diffuse" gives the channels diffuse.R, …; NULL or "" means the picture itself, with the channels R, …
    const char *name;
    const lam_image *image; // floats; all layers have the same size
    // A letter for each written component of a pixel, in order: "XYZ". NULL: "RGB", or "RGBA" for the picture itself.
    const char *channels;
    LAM_RESERVED(4);
} lam_layer;

// Encodes one EXR picture with all layers (32-bit floats, ZIP), and writes it to `path` like lam_image_save. With the
// same OpenEXR library, the same layers give the same bytes. Errors: LAM_BAD_ARGUMENT (sizes, formats, channels with
// the same name), LAM_UNSUPPORTED (OpenEXR is not in this build, or not installed), LAM_LIMIT, LAM_CANNOT_WRITE.
LAM_API bool lam_image_encode_layers(const lam_layer *layers, int count, lam_bytes *out, lam_error *error);
LAM_API bool lam_image_save_layers(const lam_layer *layers, int count, const char *path, lam_error *error);

// Gets the pixel format for a file name: LAM_RGBA32F for .pfm and .exr, LAM_RGBA8 for .png, .ppm, .jpg, .jpeg, .webp
// and .gif. Another extension fails with LAM_UNSUPPORTED and a list of the writable formats.
LAM_API bool lam_image_format_for(const char *path, lam_pixel_format *format, lam_error *error);

// These functions describe the picture format with this index (from 0): the name, which is also an extension ("png"); a
// second extension, or NULL; and one line about the stored numbers ("8 bits, sRGB, with alpha"), or NULL if the format
// is only read. lam_image_format_is_read returns whether lam_image_load reads the format. The strings are static. The functions return NULL if the index is out of
// range.
LAM_API const char *lam_image_format_name(int format);
LAM_API const char *lam_image_format_alias(int format);
LAM_API const char *lam_image_format_written(int format);
LAM_API bool lam_image_format_is_read(int format);

// Reads a picture. PNG, JPEG (CMYK without its profile), WebP (LAM_UNSUPPORTED if libwebp is missing), BMP, TGA and
// binary PPM become LAM_RGBA8: 16-bit numbers are reduced to 8 bits, and grey and palettes become RGB. PFM, EXR
// (scanlines; the first part) and Radiance (.hdr) become LAM_RGBA32F. Alpha is 1 if the file has none. The content
// determines the format; for a TGA with an invalid header, the extension does. `path` is a regular file, or "-" for
// standard input. The call ignores the previous contents of `image` and does not free them; on failure it zeroes the
// struct. `control` may be NULL; its memory limit counts the file and the pixels. Errors: LAM_CANNOT_READ,
// LAM_UNSUPPORTED, LAM_LIMIT (a side over 65535, more than 400 million pixels, memory, time), LAM_CANCELLED.
LAM_API bool lam_image_load(lam_image *image, const char *path, const lam_control *control, lam_error *error);

// Reads a picture of any of these formats into LAM_RGBA32F, linear and premultiplied. PNG (all 16 bits if present),
// JPEG, WebP, BMP, TGA and PPM are decoded from sRGB, or used unchanged, 0…1, with LAM_COLOR_RAW; PFM, EXR and Radiance
// are already linear. In all other respects the call works like lam_image_load.
LAM_API bool lam_image_load_linear(lam_image *image, const char *path, lam_color_mode color, const lam_control *control,
                                   lam_error *error);

// Returns whether the file at `path` states that Lambent wrote it: PNG by the text "Software: lambent", PPM by the
// comment "# lambent" in its second line, JPEG by the comment "lambent". Returns false for PFM and WebP, which cannot
// store such a comment, and for a file that does not exist, is not regular or is not readable. Only the beginning of
// the file is read.
LAM_API bool lam_image_is_from_lambent(const char *path);

// The difference between two pictures of the same size and format, over red, green, blue and alpha (alpha is 1 in
// formats without alpha). Differences are fractions of the full range (255 steps of a byte). The difference between a
// number and NaN or infinity is infinite.
typedef struct lam_difference {
    // The largest, mean and root mean square difference of a channel.
    double maximum, mean, rmse;
    // 20·log10(1 / rmse): infinity for equal pictures, −infinity for infinitely different ones.
    double psnr_db;
    // Fraction of the pixels with a channel that differs by more than 1/255, and by more than 2/255.
    double share_over_1, share_over_2;
    LAM_RESERVED(8);
} lam_difference;

// Measures the difference between two pictures. Fails with LAM_BAD_ARGUMENT if sizes or formats differ.
LAM_API bool lam_image_compare(const lam_image *a, const lam_image *b, lam_difference *difference, lam_error *error);

// Draws the differences between two pictures of the same size and format, LAM_RGBA8 or LAM_RGBA32F: each colour channel
// is `gain` times the larger of its own difference and alpha's difference, and alpha is 1. Black means equal. Bytes are
// clamped at 255; floats are not clamped, and are infinite if lam_image_compare finds an infinite difference. `gain` is
// finite and ≥ 0. The call makes `difference` without freeing its old contents; the caller frees it. A PNG file of
// `difference` stores raw numbers (lam_save_params). Errors: LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_image_difference(const lam_image *a, const lam_image *b, float gain, lam_image *difference,
                                  lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
