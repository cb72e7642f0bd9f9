// png_filter.h: applies PNG's row filters (PNG specification, clause 9).
#ifndef PNG_FILTER_H
#define PNG_FILTER_H

#include <stdint.h>

// Numbered as in the file.
enum png_filter {
    PNG_FILTER_NONE,
    PNG_FILTER_SUB,     // minus the pixel to the left
    PNG_FILTER_UP,      // minus the pixel above
    PNG_FILTER_AVERAGE, // minus the mean of both
    // Minus the left, upper or upper left pixel, whichever is nearest to left + upper − upper left.
    PNG_FILTER_PAETH,
};

// Filters a row of `width` RGBA pixels; `above` is the previous row (zeros for the first). `out` gets a word for each
// pixel: its bytes_per_pixel bytes of the stream, the first lowest (1: red; 2: red and alpha; 3: red, green and blue;
// 4: all), and zeros above them. It has capacity for a multiple of 4 words; the words from `width` on become zero.
void png_filter_row(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width, int bytes_per_pixel,
                    uint32_t *out);

// The pixels of a row from `first` up to, not including, `end`. The pixels on both sides are zero, the transparent
// background, which covers most of many pictures. Equal numbers mean that all pixels are zero.
struct png_span {
    int first, end;
};

// Returns the span of a row of `width` pixels. Whole blocks are examined, so some pixels at its ends may be zero too.
struct png_span png_span_of(const uint8_t *row, int width);

// Returns the span of a filtered row from its own span and the span of the row above: a filter also changes the pixel
// after a span.
struct png_span png_span_filtered(struct png_span row, struct png_span above, int width);

// Returns an estimate of the compressed size of a filtered row: Σ |byte|, with bytes as −128…127.
uint64_t png_filter_cost(const uint32_t *filtered, int width);

#endif
