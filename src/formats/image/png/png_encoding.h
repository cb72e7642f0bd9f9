// png_encoding.h: declarations shared by png_write.c and the two compressors, png_fast.c and png_best.c.
#ifndef PNG_ENCODING_H
#define PNG_ENCODING_H

#include "arena.h"
#include "call_control.h"
#include "checksum.h"
#include "png_filter.h"
#include "pool.h"

#include <lambent/image.h>

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

#endif
