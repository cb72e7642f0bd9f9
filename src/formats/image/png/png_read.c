// png_read.c: reads PNG files: common files in one step, with libdeflate or zlib, and the others row by row with libspng.
// Contains the entry for PNG in the table of formats.
#include "codec.h"
#include "fail.h"
#include "pixels.h"
#include "png_encoding.h"

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

// --- decompresses all pixels of a PNG file in one step, and then unfilters the pixels. This method needs a third of
// the time of libspng, which reads row by row with zlib. The first call loads libdeflate.
//
// Only common pictures are supported: grey, RGB or RGBA with 8 bits per channel, without a transparent colour, not
// interlaced, and without chunks between the pixels and the end. libspng reads all other pictures and damaged pictures,
// and reports errors.

#ifdef HAVE_LIBDEFLATE
#include "dynamic_library.h"
#include "pages.h"
#include "pixels.h"

#include <libdeflate.h>
#include <string.h>

enum {
    PIXELS_MIN = 1 << 14,  // for smaller pictures, opening the library takes more time than it saves
    BYTES_MAX = 128 << 20, // limits the number of decompressed bytes, because decompression cannot be cancelled
    CHUNK_EXTRA = 12,      // length, type and checksum of a chunk
};

#define FUNCTIONS(each)                                                                                                \
    each(libdeflate_alloc_decompressor) each(libdeflate_free_decompressor) each(libdeflate_zlib_decompress_ex)         \
        each(libdeflate_crc32)

struct inflater {
    void *library;
    FUNCTIONS(LIBRARY_MEMBER)
};

// --- the chunks

// Returns whether a complete chunk of this type (any type if NULL) begins at `at`. Sets *length to the length of the
// chunk's data.
static bool chunk_at(const struct picture_file *file, size_t at, const char *type, uint32_t *length)
{
    const uint8_t *chunk = (const uint8_t *)file->bytes + at;
    if (file->size - at < CHUNK_EXTRA)
        return false;
    *length = png_u32_at(chunk);
    return *length <= file->size - at - CHUNK_EXTRA && (!type || memcmp(chunk + 4, type, 4) == 0);
}

static bool is_intact(const struct inflater *d, const struct picture_file *file, size_t at, uint32_t length)
{
    const uint8_t *chunk = (const uint8_t *)file->bytes + at;
    return d->libdeflate_crc32(0, chunk + 4, (size_t)length + 4) == png_u32_at(chunk + 8 + length);
}

// Returns the position of the first chunk of pixels, or 0 if there is none.
static size_t find_pixels(const struct picture_file *file)
{
    uint32_t length;
    for (size_t at = 8; chunk_at(file, at, NULL, &length); at += (size_t)length + CHUNK_EXTRA)
        if (chunk_at(file, at, "IDAT", &length))
            return at;
    return 0;
}

// Joins the compressed bytes of the pixel chunks and returns the number of bytes. Returns 0 if a chunk is damaged, or
// if the end chunk does not follow the pixel chunks.
static size_t join_pixels(const struct inflater *d, const struct picture_file *file, size_t at, uint8_t *joined)
{
    size_t used = 0;
    uint32_t length;
    for (; chunk_at(file, at, "IDAT", &length); at += (size_t)length + CHUNK_EXTRA) {
        if (!is_intact(d, file, at, length))
            return 0;
        memcpy(joined + used, (const uint8_t *)file->bytes + at + 8, length);
        used += length;
    }
    return chunk_at(file, at, "IEND", &length) && length == 0 && is_intact(d, file, at, 0) ? used : 0;
}

// --- filters

// Four pixels of four channels. If the file has three channels or one, the fourth channel is arbitrary.
typedef uint8_t bytes16 __attribute__((vector_size(16)));
typedef uint32_t words4 __attribute__((vector_size(16)));

// Loads four bytes in memory order. Grey is copied to all channels.
static inline uint32_t pixel_at(const uint8_t *at, int channels)
{
    uint32_t pixel = *at * 0x01010101u;
    if (channels != 1)
        memcpy(&pixel, at, sizeof pixel);
    return pixel;
}

// Returns the smaller number in each lane. The code is written so that compilers use vector instructions.
static inline bytes16 min16(bytes16 x, bytes16 y)
{
    for (int i = 0; i < 16; i++)
        x[i] = x[i] < y[i] ? x[i] : y[i];
    return x;
}

static inline bytes16 max16(bytes16 x, bytes16 y)
{
    for (int i = 0; i < 16; i++)
        x[i] = x[i] > y[i] ? x[i] : y[i];
    return x;
}

// Returns, per channel, the left, upper or upper left pixel (a, b or c) that is nearest to a + b − c. If distances are
// equal, a is preferred to b, and b to c. If c is between a and b, the distance is x = high − c for the lower of the
// two, y = c − low for the higher, and |x − y| for c itself. The lower is nearest if 2x ≤ y, and the higher is nearest
// if 2y ≤ x. If 0 replaces negative differences, these conditions are also correct for all other c. Both conditions are
// met only if a = b = c. Few steps depend on a, the most recent pixel.
static inline bytes16 paeth(bytes16 a, bytes16 b, bytes16 c)
{
    const bytes16 x = max16(a, max16(b, c)) - c, y = c - min16(a, min16(b, c));
    const bytes16 takes_low = (bytes16)(max16(x, y >> 1) == y >> 1), takes_high = (bytes16)(max16(y, x >> 1) == x >> 1);
    return c + ((takes_low & (min16(a, b) - c)) + (takes_high & (max16(a, b) - c)));
}

// Returns the value that unfiltering adds to a pixel from the file.
static inline bytes16 predicted(int filter, bytes16 a, bytes16 b, bytes16 c)
{
    return filter == 1   ? a
           : filter == 2 ? b
           : filter == 3 ? (a & b) + ((a ^ b) >> 1)
           : filter == 4 ? paeth(a, b, c)
                         : (bytes16){0};
}

// Unfilters a row into pixels of `size` bytes, 3 or 4. A fourth byte is always read and written, even after the end of
// a row. `filter` and `channels` are constants after inlining.
static inline __attribute__((always_inline)) void unfilter(uint8_t *row, const uint8_t *above, const uint8_t *from,
                                                           size_t width, size_t size, int filter, int channels)
{
    const bytes16 alpha = channels < 4 ? (bytes16){0, 0, 0, 255} : (bytes16){0};
    bytes16 a = {0}, c = {0};
    for (size_t i = 0; i < width; i++, row += size, above += size, from += channels) {
        bytes16 b = (bytes16)(words4){pixel_at(above, 4)};
        a = (bytes16)(words4){pixel_at(from, channels)} + predicted(filter, a, b, c);
        c = b;
        words4 out = (words4)(a | alpha);
        memcpy(row, &out, 4);
    }
}

// Four rows that are unfiltered together. Each row is LAG pixels behind the row above it, so that the pixels do not
// wait for one another.
enum { ROWS = 4, LAG = 2, DELAY = LAG * (ROWS - 1) };

struct four_rows {
    uint8_t *row;
    const uint8_t *above, *from;
    size_t width, size;
    bytes16 a, older,
        c; // `a`: the pixels of the previous step; `older`: the pixels of the step before; `c`: the pixels above `a`
    bytes16 looks_up; // all bits are set for rows with filter 4; filter 1 is filter 4 with b = c = 0
};

// Unfilters pixel `i` of the first row, and the delayed pixels of the other rows. `inner` and `channels` are constants
// after inlining. With `inner`, all of these pixels exist, and none of them is the last of its row.
static inline __attribute__((always_inline)) void step_rows(struct four_rows *r, size_t i, bool inner, int channels)
{
    const size_t size = r->size;
    const words4 alpha =
        (words4)(channels < 4 ? (bytes16){0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255} : (bytes16){0});
    const size_t step = (size_t)channels, from_row = 1 + r->width * step;
    bool exists[ROWS];
    uint32_t pixels[ROWS] = {0};
    for (size_t k = 0; k < ROWS; k++) {
        exists[k] = inner || (i >= LAG * k && i - LAG * k < r->width);
        if (exists[k])
            pixels[k] = pixel_at(r->from + k * from_row + (i - LAG * k) * step, channels);
    }
    const words4 older = (words4)r->older;
    const bytes16 b = (bytes16)(words4){exists[0] ? pixel_at(r->above + i * size, 4) : 0, older[0], older[1], older[2]};
    const bytes16 a = (bytes16)(words4){pixels[0], pixels[1], pixels[2], pixels[3]} +
                      paeth(r->a, b & r->looks_up, r->c & r->looks_up);
    r->older = r->a;
    r->a = a;
    r->c = b;
    const words4 out = (words4)a | alpha;
    for (size_t k = 0; k < ROWS; k++) {
        const uint32_t pixel = out[k];
        if (exists[k])
            memcpy(r->row + (k * r->width + i - LAG * k) * size, &pixel, inner ? 4 : size);
    }
}

static inline __attribute__((always_inline)) void unfilter_four(struct four_rows *r, int channels)
{
    size_t i = 0, last = r->width - 1;
    for (; i < DELAY; i++)
        step_rows(r, i, false, channels);
    for (; i < last; i++)
        step_rows(r, i, true, channels);
    for (; i <= last + DELAY; i++)
        step_rows(r, i, false, channels);
}

#define UNFILTER_CASES(channels)                                                                                       \
    case 8 * channels:                                                                                                 \
        unfilter(row, above, from, width, size, 0, channels);                                                          \
        break;                                                                                                         \
    case 8 * channels + 1:                                                                                             \
        unfilter(row, above, from, width, size, 1, channels);                                                          \
        break;                                                                                                         \
    case 8 * channels + 2:                                                                                             \
        unfilter(row, above, from, width, size, 2, channels);                                                          \
        break;                                                                                                         \
    case 8 * channels + 3:                                                                                             \
        unfilter(row, above, from, width, size, 3, channels);                                                          \
        break;                                                                                                         \
    case 8 * channels + 4:                                                                                             \
        unfilter(row, above, from, width, size, 4, channels);                                                          \
        break;                                                                                                         \
    case 8 * channels + 5:                                                                                             \
        unfilter_four(&(struct four_rows){row, above, from, width, size, .looks_up = looks_up}, channels);             \
        break;

// Returns whether each of the next four rows uses filter 1 or 4. Sets all bits of *looks_up for the rows with filter 4.
static bool are_four(const uint8_t *from, size_t row_bytes, bytes16 *looks_up)
{
    words4 rows = {0};
    for (size_t k = 0; k < ROWS; k++, from += row_bytes) {
        if (*from != 1 && *from != 4)
            return false;
        rows[k] = *from == 4 ? UINT32_MAX : 0;
    }
    *looks_up = (bytes16)rows;
    return true;
}

// Unfilters the next row of the file, or the next four rows. A row consists of a filter byte and the pixels. Returns 1
// or 4, the number of rows, or 0 if the filter is unknown. `left` is the number of remaining rows.
static size_t unfilter_next(uint8_t *row, const uint8_t *above, const uint8_t *from, size_t left, size_t width,
                            size_t size, int channels)
{
    bytes16 looks_up = {0};
    bool four = left >= ROWS && width > DELAY && are_four(from, 1 + width * (size_t)channels, &looks_up);
    int filter = *from++;
    if (filter > 4)
        return 0;
    if (filter == 2 && size == (size_t)channels) {
        for (size_t i = 0; i < width * size; i++)
            row[i] = (uint8_t)(from[i] + above[i]);
        return 1;
    }
    switch (8 * channels + (four ? 5 : filter)) {
        UNFILTER_CASES(1)
        UNFILTER_CASES(3)
        UNFILTER_CASES(4)
    }
    return four ? ROWS : 1;
}

// --- whole pictures

static bool decompress(const struct inflater *d, const uint8_t *compressed, size_t size, uint8_t *out, size_t out_size)
{
    size_t used, made;
    struct libdeflate_decompressor *decompressor = size ? d->libdeflate_alloc_decompressor() : NULL;
    bool ok = decompressor &&
              d->libdeflate_zlib_decompress_ex(decompressor, compressed, size, out, out_size, &used, &made) ==
                  LIBDEFLATE_SUCCESS &&
              used == size && made == out_size;
    if (decompressor)
        d->libdeflate_free_decompressor(decompressor);
    return ok;
}

// Unfilters rows in place. The file's rows are at the end of the picture's memory, so that no pixel is overwritten
// before it is read, even if four rows are written at once.
static bool unfilter_rows(const lam_image *image, const uint8_t *rows, const uint8_t *zeros, int channels)
{
    size_t width = (size_t)image->width, height = (size_t)image->height, size = pixel_bytes(image->format), made;
    const uint8_t *above = zeros;
    for (size_t y = 0; y < height; y += made, rows += (1 + width * (size_t)channels) * made) {
        uint8_t *row = (uint8_t *)image->pixels + size * width * y;
        made = unfilter_next(row, above, rows, height - y, width, size, channels);
        if (!made)
            return false;
        above = row + size * width * (made - 1);
    }
    return true;
}

static size_t filtered_bytes(size_t width, size_t height, int channels)
{
    return (1 + width * (size_t)channels) * height;
}

size_t png_whole_extra(uint32_t width, uint32_t height, lam_pixel_format format, int channels)
{
    size_t filtered = filtered_bytes(width, height, channels), pixels = (size_t)width * height * pixel_bytes(format);
    return (filtered > pixels ? filtered - pixels : 0) + ROWS * (1 + 4 * (size_t)width);
}

bool png_read_whole(const struct picture_file *file, int channels, lam_image *image)
{
    struct inflater d;
    uint32_t width = (uint32_t)image->width, height = (uint32_t)image->height;
    size_t first = find_pixels(file), filtered = filtered_bytes(width, height, channels), zeros = 4 * (size_t)width + 1;
    if (!first || (size_t)width * height < PIXELS_MIN || filtered > BYTES_MAX ||
        library_open_functions(&d.library, "libdeflate.so.0", true, LIBRARY_NAMES(FUNCTIONS), ""))
        return false;
    size_t bytes = zeros + (file->size - first), held;
    if (file->call && !call_charge_spare(file->call, bytes))
        return false;
    uint8_t *compressed = pages_get(bytes, &held);
    bool ok = false;
    if (compressed) {
        size_t last = (size_t)width * height * pixel_bytes(image->format) +
                      png_whole_extra(width, height, image->format, channels) - 1;
        uint8_t *rows = (uint8_t *)image->pixels + (last - filtered);
        ok = decompress(&d, compressed + zeros, join_pixels(&d, file, first, compressed + zeros), rows, filtered) &&
             unfilter_rows(image, rows, compressed, channels);
        pages_free(compressed, held);
    }
    if (file->call)
        call_refund(file->call, bytes);
    return ok;
}
#else
size_t png_whole_extra(uint32_t width, uint32_t height, lam_pixel_format format, int channels)
{
    (void)width, (void)height, (void)format, (void)channels;
    return 0;
}

bool png_read_whole(const struct picture_file *file, int channels, lam_image *image)
{
    (void)file, (void)channels, (void)image;
    return false;
}
#endif
