// png_best.c: writes the smallest files, with libdeflate, which is loaded on demand. The bytes depend on the version of
// libdeflate.
//
// Each strip is filtered by six methods: with each of the five filters for all rows, and with the cheapest filter for
// each row. Compression with level 7 finds the method with the smallest result, and level 12 then compresses this
// result.
#include "png_encoding.h"

#include "fail.h"

#ifdef HAVE_LIBDEFLATE
#include "dynamic_library.h"

#include <libdeflate.h>
#include <string.h>
#include <zlib.h>

#define LIBRARY "libdeflate.so.0"
#define NEEDED  "install the Debian package libdeflate0"

enum {
    FILTERS = PNG_FILTER_PAETH + 1,
    BY_ROW = FILTERS, // chooses a filter for each row
    WAYS,
    TRIAL_LEVEL = 7, // finds nearly the same ranking as level 12 (within 1 % of the size), in 1/20 of the time
    BEST_LEVEL = 12,
    BOUNDARY = 5, // the maximum size of an empty stored block in bytes
};

#define FUNCTIONS(each)                                                                                                \
    each(libdeflate_alloc_compressor) each(libdeflate_free_compressor) each(libdeflate_deflate_compress)               \
        each(libdeflate_deflate_compress_bound)

struct libdeflate {
    void *library;
    FUNCTIONS(LIBRARY_MEMBER)
};

struct best_thread {
    const struct libdeflate *libdeflate;
    struct libdeflate_compressor *trial, *best;
    uint8_t *filtered, *smallest; // the filtered rows of a strip: of the current trial, and of the best trial so far
    uint32_t *words;              // two filtered rows
};

// The state shared by the threads, and the state of each thread.
struct best_state {
    struct libdeflate libdeflate;
    size_t count;
    struct best_thread threads[];
};

static bool open_libdeflate(struct libdeflate *d, lam_error *error)
{
    const char *fault =
        library_open_functions(&d->library, LIBRARY, false, LIBRARY_NAMES(FUNCTIONS), "lacks functions of version 1.0");
    return !fault ||
           fail(error, LAM_UNSUPPORTED, "PNG: the best compression needs " LIBRARY ", which %s; " NEEDED, fault);
}

static size_t padded_width(const struct png_encoding *encoding) { return ((size_t)encoding->image->width + 3) / 4 * 4; }

static size_t row_bytes(const struct png_encoding *encoding)
{
    return 1 + (size_t)encoding->image->width * (unsigned)encoding->bytes_per_pixel;
}

static bool best_start(struct png_encoding *encoding, struct pool *pool, struct arena *arena, lam_error *error)
{
    const size_t count = (size_t)pool_threads(pool), strip_bytes = (size_t)encoding->rows * row_bytes(encoding);
    struct best_state *state = arena_alloc_zeroed(arena, sizeof *state + count * sizeof *state->threads);
    encoding->threads = state;
    if (!state)
        return fail_memory(error, sizeof *state + count * sizeof *state->threads);
    if (!open_libdeflate(&state->libdeflate, error))
        return false;
    state->count = count;
    encoding->capacity = state->libdeflate.libdeflate_deflate_compress_bound(NULL, strip_bytes) + BOUNDARY;
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++) {
        struct best_thread *t = &state->threads[i];
        t->libdeflate = &state->libdeflate;
        t->trial = state->libdeflate.libdeflate_alloc_compressor(TRIAL_LEVEL);
        t->best = state->libdeflate.libdeflate_alloc_compressor(BEST_LEVEL);
        t->filtered = arena_alloc(arena, strip_bytes);
        t->smallest = arena_alloc(arena, strip_bytes);
        t->words = arena_array(arena, 2 * padded_width(encoding), sizeof *t->words);
        ok = t->trial && t->best && t->filtered && t->smallest && t->words;
    }
    return ok || fail_memory(error, count * (2 * strip_bytes + (10 << 20)));
}

static void best_end(struct png_encoding *encoding)
{
    struct best_state *state = encoding->threads;
    for (size_t i = 0; state && i < state->count; i++) {
        if (state->threads[i].trial)
            state->libdeflate.libdeflate_free_compressor(state->threads[i].trial);
        if (state->threads[i].best)
            state->libdeflate.libdeflate_free_compressor(state->threads[i].best);
    }
    if (state)
        library_close(state->libdeflate.library);
}

// Filters row y and stores the result in t->words. Returns the filter.
static enum png_filter filter_row(const struct png_encoding *encoding, struct best_thread *t, int y, int way)
{
    const uint8_t *row = png_pixel_row(encoding, y), *above = png_pixel_row(encoding, y - 1);
    const int width = encoding->image->width;
    if (way != BY_ROW) {
        png_filter_row((enum png_filter)way, row, above, width, encoding->bytes_per_pixel, t->words);
        return (enum png_filter)way;
    }
    uint32_t *trial = t->words + padded_width(encoding);
    uint64_t min_cost = UINT64_MAX;
    enum png_filter chosen = PNG_FILTER_NONE;
    for (enum png_filter filter = PNG_FILTER_NONE; filter <= PNG_FILTER_PAETH; filter++) {
        png_filter_row(filter, row, above, width, encoding->bytes_per_pixel, trial);
        const uint64_t cost = png_filter_cost(trial, width);
        if (cost < min_cost) {
            min_cost = cost;
            chosen = filter;
            memcpy(t->words, trial, (size_t)width * sizeof *trial);
        }
    }
    return chosen;
}

// Filters a strip and stores the result in t->filtered.
static void filter_strip(const struct png_encoding *encoding, struct best_thread *t, int strip, int way)
{
    const int top = strip * encoding->rows, rows = png_strip_rows(encoding, strip);
    const size_t pixel = (size_t)encoding->bytes_per_pixel;
    uint8_t *out = t->filtered;
    for (int y = 0; y < rows; y++) {
        *out++ = (uint8_t)filter_row(encoding, t, top + y, way);
        for (int x = 0; x < encoding->image->width; x++, out += pixel)
            memcpy(out, &t->words[x], pixel);
    }
}

// Changes the last block of a deflate stream so that it is not marked as the last, and pads the stream to a byte
// boundary with an empty stored block. The change is necessary because libdeflate writes only complete streams. zlib
// finds the start of the last block. `scratch` has capacity for the decompressed bytes. Returns the new size, or 0 if
// memory runs out.
static size_t open_stream(uint8_t *stream, size_t size, uint8_t *scratch, size_t capacity)
{
    enum { AT_BOUNDARY = 128, IN_LAST = 64, UNUSED_BITS = 7 }; // bits of z_stream.data_type after inflate(…, Z_BLOCK)
    z_stream z = {.next_in = stream, .avail_in = (uInt)size, .next_out = scratch, .avail_out = (uInt)capacity};
    if (inflateInit2(&z, -15) != Z_OK) // a raw stream
        return 0;
    size_t last = 0; // position of the last block in bits
    int code;
    while ((code = inflate(&z, Z_BLOCK)) == Z_OK && (z.data_type & (AT_BOUNDARY | IN_LAST)) != (AT_BOUNDARY | IN_LAST))
        if (z.data_type & AT_BOUNDARY)
            last = 8 * (size_t)z.total_in - (unsigned)(z.data_type & UNUSED_BITS);
    const unsigned unused = (unsigned)(z.data_type & UNUSED_BITS);
    inflateEnd(&z);
    if (code != Z_OK)
        return 0;
    stream[last / 8] &= (uint8_t)~(1u << last % 8);
    // The header of a stored block is three zero bits, and the unused bits of the stream are zero too.
    static const uint8_t boundary[BOUNDARY] = {0, 0, 0, 0xFF, 0xFF};
    const size_t skipped = unused >= 3;
    memcpy(stream + size, boundary + skipped, BOUNDARY - skipped);
    return size + BOUNDARY - skipped;
}

static size_t best_strip(struct png_encoding *encoding, int strip, int thread, struct adler_part *adler, uint8_t *out)
{
    struct best_state *state = encoding->threads;
    struct best_thread *t = &state->threads[thread];
    const size_t size = (size_t)png_strip_rows(encoding, strip) * row_bytes(encoding);
    size_t min_size = SIZE_MAX;
    for (int way = 0; way < WAYS; way++) {
        if (!call_should_continue(&encoding->call))
            return 0;
        filter_strip(encoding, t, strip, way);
        const size_t compressed =
            t->libdeflate->libdeflate_deflate_compress(t->trial, t->filtered, size, out, encoding->capacity);
        if (compressed < min_size) {
            min_size = compressed;
            uint8_t *smallest = t->filtered;
            t->filtered = t->smallest;
            t->smallest = smallest;
        }
    }
    if (!call_should_continue(&encoding->call))
        return 0;
    adler_bytes(adler, t->smallest, size);
    const size_t compressed =
        t->libdeflate->libdeflate_deflate_compress(t->best, t->smallest, size, out, encoding->capacity - BOUNDARY);
    return open_stream(out, compressed, t->filtered, size);
}
#else
static bool best_start(struct png_encoding *encoding, struct pool *pool, struct arena *arena, lam_error *error)
{
    (void)encoding, (void)pool, (void)arena;
    return fail(error, LAM_UNSUPPORTED,
                "PNG: this build does not support the best compression, because libdeflate was missing");
}
#define best_strip NULL
#define best_end   NULL
#endif

const struct png_method png_best = {
    .strip_pixels = 1 << 18, // larger strips do not reduce the file size, but delay cancellation
    .zlib_flags = 0xDA,      // the slowest level
    .start = best_start,
    .strip = best_strip,
    .end = best_end,
};
