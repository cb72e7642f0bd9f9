// png_encoding.h: what is shared while a picture becomes a PNG file: png_write.c leads, and makes the quick
// kind; png_best.c makes the small kind.
#ifndef PNG_ENCODING_H
#define PNG_ENCODING_H

#include "arena.h"
#include "checksum.h"
#include "codec.h"
#include "call_control.h"

enum { PNG_CHUNK = 12 }; // bytes of a chunk's length, type and CRC

struct png_strip {
    struct adler_part adler;
    size_t size; // of its chunk
};

struct png_encoding {
    const lam_image *image;
    int bytes_per_pixel; // 4, or 3 where every pixel is opaque
    uint32_t mask;       // of a pixel's bytes that are written
    int rows;            // in a strip
    int strips;
    size_t room; // for one strip's chunk at worst
    struct crc_tables crc;
    const uint8_t *zeros;    // the row above the first
    struct deflate *scratch; // of the quick kind, one for each thread
    struct png_best *best;   // of the small kind, likewise
    uint8_t *filters;        // of the small kind: how each strip is filtered
    int translucent;         // touched atomically: set once a pixel was found that is not opaque

    struct call_control call; // over the whole call
    int first;                // strip of this batch
    uint8_t *out;             // of this batch, `room` bytes for each strip
    struct png_strip *done;   // one for each strip of a batch
};

// Completes a chunk whose `size` bytes of data already stand at out + 8. Returns the chunk's size.
size_t png_close_chunk(const struct crc_tables *crc, const char *type, uint8_t *out, size_t size);

// A row's pixels; of row −1 those of a row of zeros.
const uint8_t *png_pixel_row(const struct png_encoding *encoding, int y);
int png_strip_rows(const struct png_encoding *encoding, int strip);

enum { PNG_BEST_PIXELS = 1 << 17 }; // of a strip of the small kind; matches reach into the strip above

// The room that a strip's stream takes at worst.
size_t png_best_room(const struct png_encoding *encoding);
// Gets memory and decides how each strip is filtered.
bool png_best_start(struct png_encoding *encoding, struct pool *pool, struct arena *arena, lam_error *error);
// Writes strip `strip`'s stream. Returns its bytes.
size_t png_best_strip(struct png_encoding *encoding, int strip, int thread, struct adler_part *adler, uint8_t *out);

#endif
