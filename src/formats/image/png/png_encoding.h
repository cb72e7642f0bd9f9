// png_encoding.h: declarations shared by png_write.c and the two compressors, png_fast.c and png_best.c.
#ifndef PNG_ENCODING_H
#define PNG_ENCODING_H

#include "arena.h"
#include "call_control.h"
#include "checksum.h"
#include "codec.h"
#include "pool.h"

#include <lambent/image.h>

#include <stdint.h>

// A picture to be encoded as PNG, in strips of rows that any thread can encode.
struct png_encoding {
    const lam_image *image;
    const uint8_t *zeros;   // the row above the first row
    struct png_span *spans; // of each row
    int bytes_per_pixel;    // 1 is grey, 2 is grey and alpha, 3 is RGB, 4 is RGBA
    int rows;               // the number of rows in each strip; the last strip may have fewer
    int strips;
    size_t capacity;          // the maximum size of a strip's stream in bytes
    void *threads;            // the method's state, one per thread
    struct call_control call; // the limits and the progress of the encoding
};

// A compression method.
struct png_method {
    int strip_pixels;   // approximate pixels per strip
    uint8_t zlib_flags; // the second byte of the zlib header (RFC 1950), which contains the level

    // Sets `capacity` and `threads`.
    bool (*start)(struct png_encoding *encoding, struct pool *pool, struct arena *arena, lam_error *error);

    // Writes one strip as deflate blocks that end on a byte boundary. No block is marked as the last. Updates the
    // checksum `adler` with the strip's filtered rows. Returns the number of bytes, or 0 if memory runs out or the call
    // must stop.
    size_t (*strip)(struct png_encoding *encoding, int strip, int thread, struct adler_part *adler, uint8_t *out);

    // Frees memory that the arena does not own. This function is also called if `start` failed. `end` is NULL if the
    // arena owns all memory.
    void (*end)(struct png_encoding *encoding);
};

extern const struct png_method png_fast, png_best;

// The channels that a picture has in addition to grey, as bits.
enum png_channels { PNG_COLORED = 1, PNG_TRANSLUCENT = 2, PNG_ALL_CHANNELS = 3 };

// Like png_write, but writes at least the channels that *channels contains. Sets *channels to the channels in the file.
bool png_write_channels(const lam_image *image, const lam_save_params *params, struct pool *pool, int *channels,
                        lam_bytes *out, lam_error *error);

// png_put_u32 writes a 32-bit number, highest byte first. png_close_chunk completes a chunk with `size` bytes of data
// at out + 8, and returns the size of the chunk.
void png_put_u32(uint8_t *at, uint32_t value);
size_t png_close_chunk(const struct crc_tables *crc, const char *type, uint8_t *out, size_t size);

// Returns the RGBA pixels of a row. The pixels of row −1 are zero.
static inline const uint8_t *png_pixel_row(const struct png_encoding *encoding, int y)
{
    if (y < 0)
        return encoding->zeros;
    return (const uint8_t *)encoding->image->pixels + (size_t)y * (size_t)encoding->image->width * 4;
}

static inline int png_strip_rows(const struct png_encoding *encoding, int strip)
{
    const int left = encoding->image->height - strip * encoding->rows;
    return left < encoding->rows ? left : encoding->rows;
}

// --- applies the row filters of PNG (PNG specification, clause 9).

// The filters, numbered as in the file.
enum png_filter {
    PNG_FILTER_NONE,
    PNG_FILTER_SUB,     // minus the pixel to the left
    PNG_FILTER_UP,      // minus the pixel above
    PNG_FILTER_AVERAGE, // minus the mean of the left pixel and the pixel above
    // Minus the left, upper or upper left pixel, whichever is nearest to left + upper − upper left.
    PNG_FILTER_PAETH,
};

// Filters a row of `width` RGBA pixels; `above` is the previous row (zeros for the first). `out` receives one word for
// each pixel. The lowest bytes_per_pixel bytes of a word go to the stream. 1 byte is red; 2 bytes are red and alpha; 3
// bytes are red, green and blue; 4 bytes are all channels. The other bytes are zero. `out` has capacity for a multiple
// of 4 words; the words after the first `width` become zero.
void png_filter_row(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width, int bytes_per_pixel,
                    uint32_t *out);

// The pixels of a row from `first` up to, but not including, `end`. All other pixels of the row are zero (transparent
// background). Many pictures consist mostly of such pixels. If `first` and `end` are equal, all pixels are zero.
struct png_span {
    int first, end;
};

// Returns the span of a row of `width` pixels. Whole blocks are examined, so some pixels at the ends of the span may
// also be zero.
struct png_span png_span_of(const uint8_t *row, int width);

// Returns the span of a filtered row, computed from the spans of the unfiltered row and of the row above. The span can
// be longer than both of these spans, because a pixel also affects the next filtered pixel.
struct png_span png_span_filtered(struct png_span row, struct png_span above, int width);

// Returns an estimate of the compressed size of a filtered row: Σ |byte|, with bytes as −128…127.
uint64_t png_filter_cost(const uint32_t *filtered, int width);

// --- reads all pixels of common PNG files in one step.

static inline uint32_t png_u32_at(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

// Fills an image (LAM_RGBA8 or LAM_RGB8) from a PNG file that is not interlaced and has 1, 3 or 4 channels of 8 bits (4
// only for LAM_RGBA8). The chunks before the pixels must have been checked. The image needs png_whole_extra more bytes
// after its pixels, because the rows of the file are unfiltered in place. If the function returns false, libspng must
// read the picture and report the error.
bool png_read_whole(const struct picture_file *file, int channels, lam_image *image);
size_t png_whole_extra(uint32_t width, uint32_t height, lam_pixel_format format, int channels);

#endif
