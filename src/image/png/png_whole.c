// png_whole.c: decompresses all pixels of a PNG file in one step with libdeflate, which is opened on first use, and
// then unfilters them. This method takes a third of the time of libspng, which reads row by row with zlib.
//
// Only common pictures are supported: grey, RGB or RGBA with 8 bits per channel, without a transparent colour, not
// interlaced, and without chunks between the pixels and the end. libspng reads all other pictures and damaged pictures,
// and reports errors.
#include "png_whole.h"

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

// Returns whether there is a complete chunk of a type at a position, and gets the length of the chunk.
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

// Joins the compressed bytes of the pixel chunks and returns their number. Returns 0 if the end chunk does not follow
// the pixel chunks.
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

// The channels of a pixel are in the lower four of eight lanes. If the file has three channels or one, the fourth lane
// is arbitrary.
typedef uint8_t bytes8 __attribute__((vector_size(8)));
typedef uint8_t bytes16 __attribute__((vector_size(16)));
typedef uint32_t words4 __attribute__((vector_size(16)));
typedef int16_t wide8 __attribute__((vector_size(16)));

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define WIDE(i) 16 + (i), i
#else
#define WIDE(i) i, 16 + (i)
#endif

static inline wide8 wide_of(uint32_t pixel)
{
    const bytes16 bytes = (bytes16)(words4){pixel}, zero = {0};
    return (wide8)__builtin_shufflevector(bytes, zero, WIDE(0), WIDE(1), WIDE(2), WIDE(3), WIDE(4), WIDE(5), WIDE(6),
                                          WIDE(7));
}

// Loads four bytes in memory order.
static inline uint32_t pixel_at(const uint8_t *at)
{
    uint32_t pixel;
    memcpy(&pixel, at, sizeof pixel);
    return pixel;
}

static inline void store_pixel(uint8_t *at, wide8 v)
{
    const bytes8 bytes = __builtin_convertvector(v, bytes8);
    memcpy(at, &bytes, 4);
}

// Returns the smaller number in each lane. The code is written so that compilers use vector instructions.
static inline wide8 min8(wide8 x, wide8 y)
{
    for (int i = 0; i < 8; i++)
        x[i] = x[i] < y[i] ? x[i] : y[i];
    return x;
}

static inline wide8 max8(wide8 x, wide8 y)
{
    for (int i = 0; i < 8; i++)
        x[i] = x[i] > y[i] ? x[i] : y[i];
    return x;
}

// Returns, per channel, the left, upper or upper left pixel (a, b or c) that is nearest to a + b − c. If distances are
// equal, the first of them is used. If c is between a and b, the distance is high − c for the lower of both, c − low
// for the higher, and |low + high − 2c| for c itself. The lower is nearest if 3c − a − b ≥ high, and the higher is
// nearest if 3c − a − b ≤ low. These conditions are also correct for all other c. Only a few steps depend on a, the
// most recent pixel.
static inline wide8 paeth(wide8 a, wide8 b, wide8 c)
{
    const wide8 low = min8(a, b), high = max8(a, b), middle = (c + c + c - b) - a;
    const wide8 takes_low = high <= middle, takes_high = middle <= low;
    const wide8 other = (takes_low & low) | (~takes_low & c);
    return (takes_high & high) | (~takes_high & other);
}

// Unfilters to pixels of `size` bytes, 3 or 4. A fourth byte is always read and written, even after the end of a row.
// `filter` and `channels` are constants after inlining.
static inline __attribute__((always_inline)) void unfilter(uint8_t *row, const uint8_t *above, const uint8_t *from,
                                                           size_t width, size_t size, int filter, int channels)
{
    const wide8 alpha = channels < 4 ? (wide8){0, 0, 0, 255} : (wide8){0};
    wide8 a = {0}, c = {0};
    for (size_t i = 0; i < width; i++, row += size, above += size, from += channels) {
        // Grey is copied to three channels.
        wide8 v = wide_of(channels == 1 ? from[0] * 0x01010101u : pixel_at(from)), b = wide_of(pixel_at(above));
        v += filter == 1 ? a : filter == 2 ? b : filter == 3 ? (a + b) >> 1 : filter == 4 ? paeth(a, b, c) : (wide8){0};
        a = v & 255;
        c = b;
        store_pixel(row, a | alpha);
    }
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
        break;

// Unfilters a row of the file, which consists of a filter byte and the pixels. Returns false if the filter is unknown.
static bool unfilter_row(uint8_t *row, const uint8_t *above, const uint8_t *from, size_t width, size_t size,
                         int channels)
{
    int filter = *from++;
    if (filter > 4)
        return false;
    switch (8 * channels + filter) {
        UNFILTER_CASES(1)
        UNFILTER_CASES(3)
        UNFILTER_CASES(4)
    }
    return true;
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
// before it is read.
static bool unfilter_rows(const lam_image *image, const uint8_t *rows, const uint8_t *zeros, int channels)
{
    size_t width = (size_t)image->width, height = (size_t)image->height, size = pixel_bytes(image->format);
    const uint8_t *above = zeros;
    bool ok = true;
    for (size_t y = 0; ok && y < height; y++, rows += 1 + width * (size_t)channels) {
        uint8_t *row = (uint8_t *)image->pixels + size * width * y;
        ok = unfilter_row(row, above, rows, width, size, channels);
        above = row;
    }
    return ok;
}

static size_t filtered_bytes(size_t width, size_t height, int channels)
{
    return (1 + width * (size_t)channels) * height;
}

size_t png_whole_extra(uint32_t width, uint32_t height, lam_pixel_format format, int channels)
{
    size_t filtered = filtered_bytes(width, height, channels), pixels = (size_t)width * height * pixel_bytes(format);
    return (filtered > pixels ? filtered - pixels : 0) + 1;
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
