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
    // minus that of left, above and above left which is nearest to left + above − above left
    PNG_FILTER_PAETH,
};

// Filters a row of `width` RGBA pixels, `above` being the row before it (zeros for the first), into `out`,
// which has room for a multiple of 4 pixels; the words from `width` up to there become zero. Each word is
// masked by `mask`.
void png_filter_row(enum png_filter filter, const uint8_t *row, const uint8_t *above, int width, uint32_t mask,
                    uint32_t *out);

// The pixels of a row from `first` to before `end`; those on both sides are zero: the transparent background,
// most of many a picture. Equal numbers: all are.
struct png_span {
    int first, end;
};

// Of a row of `width` pixels; pixels are looked at by blocks, so that some at its ends may be zero too.
struct png_span png_span_of(const uint8_t *row, int width);

// What a filter can leave of such a row below such another one: it puts the difference to a pixel at the next
// one, too.
struct png_span png_span_filtered(struct png_span row, struct png_span above, int width);

// How hard a filtered row looks to compress: Σ |byte| with bytes as −128…127.
uint64_t png_filter_cost(const uint32_t *filtered, int width);

#endif
