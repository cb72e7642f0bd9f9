// png_read.c: defines the entry for PNG in the table of formats, and reads PNG files with libspng. png_whole.c reads
// the pixels of common files.
#include "codec.h"
#include "fail.h"
#include "pixels.h"
#include "png_whole.h"

#include <spng.h>
#include <string.h>

static const uint8_t signature[8] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};

static bool png_probe(const uint8_t *bytes, size_t size)
{
    return size >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

// Returns whether a chunk before the pixels contains the text "Software: lambent".
static bool png_ours(const uint8_t *bytes, size_t size)
{
    static const char wanted[] = "tEXtSoftware\0lambent";
    const uint32_t length = sizeof wanted - 1 - 4; // without the chunk's type
    for (size_t at = sizeof signature; size - at >= 8;) {
        uint32_t chunk = png_u32_at(bytes + at);
        const uint8_t *type = bytes + at + 4;
        if (memcmp(type, "IDAT", 4) == 0)
            return false;
        if (chunk == length && size - at >= 8 + length && memcmp(type, wanted, 4 + length) == 0)
            return true;
        if (chunk > size || size - at < (size_t)chunk + 12)
            return false;
        at += (size_t)chunk + 12;
    }
    return false;
}

// One byte of a deflate stream expands to at most 1032 bytes, so a small file that declares a huge picture is rejected
// before memory is allocated.
static bool fits(const struct spng_ihdr *header, size_t size)
{
    static const int channels[7] = {1, 0, 3, 1, 2, 0, 4};
    uint64_t bits = (uint64_t)header->width * header->bit_depth * (unsigned)channels[header->color_type];
    return (bits / 8 + 1) * header->height / 1032 <= size;
}

// Converts 16-bit values to floats. The values are in the second half of the pixels' memory and are converted in
// ascending order, so each value is read before its memory is overwritten.
static void widen(lam_image *image)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    float *out = image->pixels;
    const char *from = (const char *)image->pixels + 8 * count;
    for (size_t i = 0; i < count; i++) {
        uint16_t numbers[4];
        memcpy(numbers, from + 8 * i, sizeof numbers);
        for (int channel = 0; channel < 4; channel++)
            out[4 * i + (size_t)channel] = (float)numbers[channel] / 65535.0f;
    }
}

// Returns whether pixels can have an alpha below 1.
static bool has_alpha(spng_ctx *spng, const struct spng_ihdr *header)
{
    struct spng_trns transparent;
    return header->color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
           header->color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA ||
           spng_get_trns(spng, &transparent) != SPNG_ECHUNKAVAIL;
}

// Returns the number of channels of a picture, or 0 if png_read_whole does not support the picture.
static int whole_channels(const struct spng_ihdr *header, bool alpha)
{
    if (header->bit_depth != 8 || header->interlace_method != SPNG_INTERLACE_NONE)
        return 0;
    return header->color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA       ? 4
           : header->color_type == SPNG_COLOR_TYPE_TRUECOLOR && !alpha ? 3
           : header->color_type == SPNG_COLOR_TYPE_GRAYSCALE && !alpha ? 1
                                                                       : 0;
}

// Decodes row by row, in the order of the file. In an interlaced file, seven passes over the picture are stored one
// after the other.
static bool decode_rows(spng_ctx *spng, const struct picture_file *file, bool keep, lam_image *image, lam_error *error)
{
    struct spng_row_info row = {0};
    size_t row_bytes = (keep ? 8 : pixel_bytes(image->format)) * (size_t)image->width;
    char *pixels = (char *)image->pixels + (keep ? row_bytes * (size_t)image->height : 0);
    bool rgb = image->format == LAM_RGB8;
    int code = spng_decode_image(spng, NULL, 0,
                                 keep  ? SPNG_FMT_RGBA16
                                 : rgb ? SPNG_FMT_RGB8
                                       : SPNG_FMT_RGBA8,
                                 (rgb ? 0 : SPNG_DECODE_TRNS) | SPNG_DECODE_PROGRESSIVE);
    for (int64_t count = 0; !code; count++) {
        code = spng_get_row_info(spng, &row);
        if (!code && !picture_continues(file, count, error))
            return false;
        if (!code)
            code = spng_decode_row(spng, pixels + (size_t)row.row_num * row_bytes, row_bytes);
    }
    if (code == SPNG_EOI)
        // reads to the end of the file, so that a truncation after the pixels is also an error
        code = spng_decode_chunks(spng);
    // zlib's initialisation fails only if an allocation fails
    if (code == SPNG_EMEM || code == SPNG_EZLIB_INIT)
        return fail_memory(error, row_bytes);
    return !code || fail(error, LAM_CANNOT_READ, "%s: PNG pixels: %s", file->name, spng_strerror(code));
}

// Sets *wide to true, and keeps all bits, if the file has 16 bits per channel. If `wide` is NULL, 16-bit samples are
// converted to 8 bits, and an alpha channel is added if the file has none.
static bool decode(spng_ctx *spng, const struct picture_file *file, lam_image *image, bool *wide, lam_error *error)
{
    struct spng_ihdr header;
    enum { MAX_CHUNK_BYTES = 64 << 20 }; // limits the decompressed size of texts and profiles
    int code = spng_set_chunk_limits(spng, MAX_CHUNK_BYTES, MAX_CHUNK_BYTES);
    if (!code)
        code = spng_set_png_buffer(spng, file->bytes, file->size);
    if (!code)
        code = spng_get_ihdr(spng, &header);
    if (code == SPNG_EMEM)
        return fail_memory(error, file->size);
    if (code)
        return fail(error, LAM_CANNOT_READ, "%s: PNG header: %s", file->name, spng_strerror(code));
    if (!picture_size_check(file, header.width, header.height, error))
        return false;
    if (!fits(&header, file->size))
        return fail(error, LAM_CANNOT_READ, "%s: PNG of %u×%u pixels, which cannot be in a file of %zu bytes",
                    file->name, header.width, header.height, file->size);
    bool keep = wide && header.bit_depth == 16;
    if (wide)
        *wide = keep;
    code = spng_decode_chunks(spng); // the chunks before the pixels
    if (code == SPNG_EMEM)
        return fail_memory(error, file->size);
    if (code)
        return fail(error, LAM_CANNOT_READ, "%s: PNG pixels: %s", file->name, spng_strerror(code));
    bool alpha = has_alpha(spng, &header);
    lam_pixel_format format = keep ? LAM_RGBA32F : wide && !alpha ? LAM_RGB8 : LAM_RGBA8;
    int channels = whole_channels(&header, alpha);
    size_t extra = channels ? png_whole_extra(header.width, header.height, format, channels) : 0;
    if (!picture_make_larger(file, header.width, header.height, format, extra, image, error))
        return false;
    if (channels && png_read_whole(file, channels, image))
        return true;
    if (!decode_rows(spng, file, keep, image, error))
        return false;
    if (keep)
        widen(image);
    return true;
}

static bool png_read_wide(const struct picture_file *file, lam_image *image, bool *wide, lam_error *error)
{
    spng_ctx *spng = spng_ctx_new(0);
    if (!spng)
        return fail_memory(error, 1 << 15);
    bool ok = decode(spng, file, image, wide, error);
    spng_ctx_free(spng);
    if (!ok)
        picture_free(file->call, image);
    return ok;
}

static bool png_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    return png_read_wide(file, image, NULL, error);
}

const struct codec codec_png = {
    .name = "png",
    .title = "PNG",
    .written = "8 bits, sRGB, with alpha",
    .pixels = LAM_RGBA8,
    .write = png_write,
    .probe = png_probe,
    .read = png_read,
    .read_wide = png_read_wide,
    .ours = png_ours,
};
