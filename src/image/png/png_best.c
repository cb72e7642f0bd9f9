// png_best.c: PNG files that are as small as a second or two of work makes them.
//
// Each strip is filtered in the way that compresses best by a quick estimate: all rows by one filter, or each
// row by the one that leaves the least. Then the strip is squeezed (squeeze.h), with matches that reach into
// the strips above; what stood there is filtered once more, so strips still go in parallel.
#include "png_encoding.h"

#include "fail.h"
#include "png_filter.h"
#include "squeeze.h"

#include <string.h>

enum {
    FILTERS = PNG_FILTER_PAETH + 1,
    EACH_ROW = FILTERS, // the way of filtering that chooses for each row
    WAYS,
};

struct png_best {
    struct squeeze *squeeze;
    uint8_t *bytes;  // filtered rows: the window's and the strip's
    uint32_t *words; // a filtered row, and another
    size_t words_room;
};

static size_t row_bytes(const struct png_encoding *encoding)
{
    return 1 + (size_t)encoding->image->width * (unsigned)encoding->bytes_per_pixel;
}

static int window_rows(const struct png_encoding *encoding)
{
    return (int)((SQUEEZE_WINDOW - 1) / row_bytes(encoding)) + 1;
}

size_t png_best_room(const struct png_encoding *encoding)
{
    return squeeze_room((size_t)encoding->rows * row_bytes(encoding));
}

// Filters row y into best->words. Returns the filter.
static enum png_filter filter_row(const struct png_encoding *encoding, struct png_best *best, int y, int way)
{
    const uint8_t *row = png_pixel_row(encoding, y), *above = png_pixel_row(encoding, y - 1);
    const int width = encoding->image->width;
    if (way != EACH_ROW) {
        png_filter_row((enum png_filter)way, row, above, width, encoding->mask, best->words);
        return (enum png_filter)way;
    }
    uint64_t least = UINT64_MAX;
    enum png_filter chosen = PNG_FILTER_NONE;
    for (int f = PNG_FILTER_NONE; f < FILTERS; f++) {
        const enum png_filter filter = (enum png_filter)f;
        uint32_t *words = best->words + best->words_room;
        png_filter_row(filter, row, above, width, encoding->mask, words);
        uint64_t cost = png_filter_cost(words, width);
        if (cost < least) {
            least = cost;
            chosen = filter;
            memcpy(best->words, words, best->words_room * sizeof *words);
        }
    }
    return chosen;
}

// Row y as the stream has it, and added to `adler` where there is one.
static void put_row(const struct png_encoding *encoding, struct png_best *best, int y, int way,
                    struct adler_part *adler, uint8_t *out)
{
    const int width = encoding->image->width;
    *out++ = (uint8_t)filter_row(encoding, best, y, way);
    if (adler) {
        adler_byte(adler, out[-1]);
        adler_row(adler, best->words, width, encoding->bytes_per_pixel);
    }
    if (encoding->bytes_per_pixel == 4) {
        memcpy(out, best->words, (size_t)width * 4);
        return;
    }
    for (int x = 0; x < width; x++, out += 3)
        memcpy(out, &best->words[x], 3);
}

static void choose_way(void *user, size_t index, int thread)
{
    struct png_encoding *encoding = user;
    struct png_best *best = &encoding->best[thread];
    const int rows = png_strip_rows(encoding, (int)index), top = (int)index * encoding->rows;
    const size_t each = row_bytes(encoding);
    uint64_t least = UINT64_MAX;
    for (int way = 0; way < WAYS && call_should_continue(&encoding->call); way++) {
        for (int y = 0; y < rows; y++)
            put_row(encoding, best, top + y, way, NULL, best->bytes + (size_t)y * each);
        uint64_t bits = squeeze_estimate(best->squeeze, best->bytes, (size_t)rows * each, each);
        if (bits < least) {
            least = bits;
            encoding->filters[index] = (uint8_t)way;
        }
    }
}

bool png_best_start(struct png_encoding *encoding, struct pool *pool, struct arena *arena, lam_error *error)
{
    const size_t threads = (size_t)pool_threads(pool), strips = (size_t)encoding->strips;
    const size_t room = (size_t)(window_rows(encoding) + encoding->rows) * row_bytes(encoding);
    encoding->best = arena_array(arena, threads, sizeof *encoding->best);
    encoding->filters = arena_alloc_zeroed(arena, strips);
    bool ok = encoding->best && encoding->filters;
    for (size_t i = 0; ok && i < threads; i++) {
        struct png_best *best = &encoding->best[i];
        best->words_room = ((size_t)encoding->image->width + 3) / 4 * 4;
        best->squeeze = squeeze_make(arena);
        best->bytes = arena_alloc(arena, room);
        best->words = arena_array(arena, 2 * best->words_room, sizeof *best->words);
        ok = best->squeeze && best->bytes && best->words;
    }
    if (!ok)
        return fail_memory(error, threads * (room + (8 << 20)));
    pool_run(pool, strips, choose_way, encoding);
    return call_should_continue(&encoding->call) || call_error(&encoding->call, error);
}

size_t png_best_strip(struct png_encoding *encoding, int strip, int thread, struct adler_part *adler, uint8_t *out)
{
    struct png_best *best = &encoding->best[thread];
    const int top = strip * encoding->rows, rows = png_strip_rows(encoding, strip);
    const int window = window_rows(encoding) < top ? window_rows(encoding) : top;
    const size_t each = row_bytes(encoding);
    for (int y = -window; y < rows; y++)
        put_row(encoding, best, top + y, encoding->filters[(top + y) / encoding->rows], y < 0 ? NULL : adler,
                best->bytes + (size_t)(y + window) * each);
    return squeeze(best->squeeze, best->bytes, (size_t)window * each, (size_t)rows * each, each, out);
}
