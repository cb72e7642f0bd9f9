// png_filter.h: applies the row filters of PNG (PNG specification, clause 9).
#ifndef PNG_FILTER_H
#define PNG_FILTER_H

#include <stdint.h>

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

#endif
