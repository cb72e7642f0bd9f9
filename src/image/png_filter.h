// png_filter.h: PNG's row filters (PNG specification, clause 9), forward.
#ifndef PNG_FILTER_H
#define PNG_FILTER_H

#include <stdint.h>

// As they are numbered in the file.
enum png_filter {
    PNG_FILTER_NONE,
    PNG_FILTER_SUB,     // minus the pixel to the left
    PNG_FILTER_UP,      // minus the one above
    PNG_FILTER_AVERAGE, // minus the mean of both
    PNG_FILTER_PAETH,   // minus that of left, above and above left which is nearest to left + above − above
                        // left
};

// Filters a row of `width` RGBA pixels, `above` being the row before it (zeros for the first), into `out`,
// which has room for a multiple of 4 pixels; the words from `width` up to there become zero. Each word is
// masked by `mask`.
void png_filter_row(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width,
                    uint32_t mask, uint32_t *out);

// How hard a filtered row looks to compress: Σ |byte| with bytes as −128…127.
uint64_t png_filter_cost(const uint32_t *filtered, int width);

#endif
