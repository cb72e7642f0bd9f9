// png_fast.c: implements the default compression: one filter for each strip, then the compression of deflate.h.
#include "deflate.h"
#include "fail.h"
#include "png_encoding.h"

#include <string.h>

enum { TRIAL_STEP = 8 }; // every filter is tried on every eighth row

static int first_trial(int rows) { return rows < TRIAL_STEP ? 0 : TRIAL_STEP / 2; }

static struct png_span span_at(const struct png_encoding *encoding, int y)
{
    const struct png_span none = {0};
    return png_span_filtered(encoding->spans[y], y > 0 ? encoding->spans[y - 1] : none, encoding->image->width);
}

static void filter_span(const struct png_encoding *encoding, enum png_filter filter, int y, struct png_span span,
                        uint32_t *out)
{
    const size_t offset = 4 * (size_t)span.first;
    png_filter_row(filter, png_pixel_row(encoding, y) + offset, png_pixel_row(encoding, y - 1) + offset,
                   span.end - span.first, encoding->bytes_per_pixel, out);
}

// Returns the filter with the lowest cost, summed over some of the strip's rows. If several costs are equal, the filter
// with the highest number is used.
static enum png_filter choose_filter(const struct png_encoding *encoding, struct deflate *scratch, int top, int rows)
{
    uint64_t cost[PNG_FILTER_PAETH + 1] = {0};
    enum png_filter best = PNG_FILTER_PAETH;
    for (int y = first_trial(rows); y < rows; y += TRIAL_STEP) {
        const struct png_span span = span_at(encoding, top + y);
        for (enum png_filter filter = PNG_FILTER_SUB; filter <= PNG_FILTER_PAETH; filter++) {
            filter_span(encoding, filter, top + y, span, scratch->words);
            cost[filter] += png_filter_cost(scratch->words, span.end - span.first);
        }
    }
    for (enum png_filter filter = PNG_FILTER_PAETH; filter >= PNG_FILTER_SUB; filter--)
        if (cost[filter] < cost[best])
            best = filter;
    return best;
}

// Returns whether the sampled rows of a strip are grey, although other rows of the picture may have colours.
static bool is_grey(const struct png_encoding *encoding, int top, int rows)
{
    uint32_t differ = 0;
    for (int y = first_trial(rows); y < rows; y += TRIAL_STEP) {
        const uint8_t *row = png_pixel_row(encoding, top + y);
        for (int x = 0; x < encoding->image->width; x++) {
            uint32_t pixel;
            memcpy(&pixel, row + 4 * (size_t)x, 4);
            differ |= pixel ^ pixel >> 8; // compares red with green, and green with blue
        }
    }
    return (differ & 0xFFFF) == 0;
}

static size_t fast_strip(struct png_encoding *encoding, int strip, int thread, struct adler_part *adler, uint8_t *out)
{
    struct deflate *scratch = &((struct deflate *)encoding->threads)[thread];
    const int width = encoding->image->width;
    const size_t pixel = (size_t)encoding->bytes_per_pixel;
    const int top = strip * encoding->rows, rows = png_strip_rows(encoding, strip);
    const enum png_filter filter = choose_filter(encoding, scratch, top, rows);
    deflate_start(scratch, (uint8_t)filter, encoding->bytes_per_pixel < 3 || is_grey(encoding, top, rows));
    for (int y = 0; y < rows; y++) {
        const struct png_span span = span_at(encoding, top + y);
        memset(scratch->row, 0, (size_t)span.first * 4);
        filter_span(encoding, filter, top + y, span, scratch->row + span.first);
        memset(scratch->row + span.end, 0, (size_t)(width - span.end) * 4);
        adler_byte(adler, (uint8_t)filter);
        adler_zeros(adler, (size_t)span.first * pixel);
        adler_row(adler, scratch->row + span.first, span.end - span.first, encoding->bytes_per_pixel);
        adler_zeros(adler, (size_t)(width - span.end) * pixel);
        deflate_row(scratch, span.first, span.end);
    }
    return deflate_write(scratch, out);
}

// Allocates memory for each thread: about 12 bytes per pixel of a strip.
static bool fast_start(struct png_encoding *encoding, struct pool *pool, struct arena *arena, lam_error *error)
{
    const size_t threads = (size_t)pool_threads(pool);
    const int width = encoding->image->width, rows = encoding->rows;
    struct deflate *scratch = encoding->threads = arena_array(arena, threads, sizeof *scratch);
    bool ok = scratch != NULL;
    for (size_t i = 0; ok && i < threads; i++)
        ok = deflate_make(&scratch[i], arena, width, rows, encoding->bytes_per_pixel);
    encoding->capacity = deflate_capacity(width, rows, encoding->bytes_per_pixel);
    return ok || fail_memory(error, threads * deflate_scratch(width, rows));
}

const struct png_method png_fast = {
    .strip_pixels = 1 << 15, // the words of a strip fit into the second-level cache, and the Huffman codes of a strip
                             // need only about 80 bytes
    .zlib_flags = 0x01,      // the fastest level
    .start = fast_start,
    .strip = fast_strip,
};
