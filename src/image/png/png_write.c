// png_write.c: pictures become PNG files, in parallel strips and yet always the same bytes.
//
// Rows are cut into strips whose height depends on the width alone. A strip takes one row filter, is
// compressed by itself (deflate.h) and becomes one IDAT chunk with its own CRC, so that any thread may take
// any strip; only the Adler-32 of the whole is joined at the end. A filter looks at the row above, which is
// there whichever strip it is in. The small kind (png_best.c) is made likewise, of larger strips.
#include "png_encoding.h"

#include "arena.h"
#include "deflate.h"
#include "fail.h"
#include "png_filter.h"

#include <stdlib.h>
#include <string.h>

enum {
    STRIP_PIXELS = 32768, // a strip's words stay in the second-level cache; its Huffman code costs about 80 bytes
    BATCH_STRIPS = 256,   // strips between two joinings: bounds the room that waits for the worst case
    TRIAL_STEP = 8,       // each eighth row is tried with every filter
};

static void put_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

size_t png_close_chunk(const struct crc_tables *crc, const char *type, uint8_t *out, size_t size)
{
    put_u32(out, (uint32_t)size);
    memcpy(out + 4, type, 4);
    put_u32(out + 8 + size, crc_of(crc, out + 4, size + 4));
    return size + PNG_CHUNK;
}

static size_t put_chunk(const struct crc_tables *crc, const char *type, const void *data, size_t size, uint8_t *out)
{
    if (size)
        memcpy(out + 8, data, size);
    return png_close_chunk(crc, type, out, size);
}

const uint8_t *png_pixel_row(const struct png_encoding *encoding, int y)
{
    if (y < 0)
        return encoding->zeros;
    return (const uint8_t *)encoding->image->pixels + (size_t)y * (size_t)encoding->image->width * 4;
}

int png_strip_rows(const struct png_encoding *encoding, int strip)
{
    int left = encoding->image->height - strip * encoding->rows;
    return left < encoding->rows ? left : encoding->rows;
}

static void look_for_translucent(void *user, size_t index, int thread)
{
    (void)thread;
    struct png_encoding *encoding = user;
    if (__atomic_load_n(&encoding->translucent, __ATOMIC_RELAXED))
        return;
    const uint8_t *pixels = png_pixel_row(encoding, (int)index * encoding->rows);
    size_t count = (size_t)png_strip_rows(encoding, (int)index) * (size_t)encoding->image->width;
    for (size_t i = 0; i < count;) {
        uint8_t all = 255;
        for (size_t end = count - i < 4096 ? count : i + 4096; i < end; i++)
            all &= pixels[4 * i + 3];
        if (all != 255) {
            __atomic_store_n(&encoding->translucent, 1, __ATOMIC_RELAXED);
            return;
        }
    }
}

static int first_trial(int rows) { return rows < TRIAL_STEP ? 0 : TRIAL_STEP / 2; }

static struct png_span span_at(const struct png_encoding *encoding, int y)
{
    const int width = encoding->image->width;
    return png_span_filtered(png_span_of(png_pixel_row(encoding, y), width),
                             png_span_of(png_pixel_row(encoding, y - 1), width), width);
}

static void filter_span(const struct png_encoding *encoding, enum png_filter filter, int y, struct png_span span,
                        uint32_t *out)
{
    const size_t offset = 4 * (size_t)span.first;
    png_filter_row(filter, png_pixel_row(encoding, y) + offset, png_pixel_row(encoding, y - 1) + offset,
                   span.end - span.first, encoding->mask, out);
}

// The filter that leaves the least on some of the strip's rows; of equals the highest number.
static enum png_filter best_filter(const struct png_encoding *encoding, struct deflate *scratch, int top, int rows)
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

// Whether the rows that were tried hold grey alone: what is no picture of coloured light.
static bool is_grey(const struct png_encoding *encoding, int top, int rows)
{
    uint32_t differ = 0;
    for (int y = first_trial(rows); y < rows; y += TRIAL_STEP) {
        const uint8_t *row = png_pixel_row(encoding, top + y);
        for (int x = 0; x < encoding->image->width; x++) {
            uint32_t pixel;
            memcpy(&pixel, row + 4 * (size_t)x, 4);
            differ |= pixel ^ pixel >> 8; // green against red, blue against green
        }
    }
    return (differ & 0xFFFF) == 0;
}

static size_t quick_strip(struct png_encoding *encoding, int strip, int thread, struct adler_part *adler, uint8_t *out)
{
    struct deflate *scratch = &encoding->scratch[thread];
    const int width = encoding->image->width;
    const size_t pixel = (size_t)encoding->bytes_per_pixel;
    const int top = strip * encoding->rows, rows = png_strip_rows(encoding, strip);
    const enum png_filter filter = best_filter(encoding, scratch, top, rows);
    deflate_start(scratch, (uint8_t)filter, is_grey(encoding, top, rows));
    struct png_span above = png_span_of(png_pixel_row(encoding, top - 1), width);
    for (int y = 0; y < rows; y++) {
        const struct png_span here = png_span_of(png_pixel_row(encoding, top + y), width);
        const struct png_span span = png_span_filtered(here, above, width);
        memset(scratch->row, 0, (size_t)span.first * 4);
        filter_span(encoding, filter, top + y, span, scratch->row + span.first);
        memset(scratch->row + span.end, 0, (size_t)(width - span.end) * 4);
        adler_byte(adler, (uint8_t)filter);
        adler_zeros(adler, (size_t)span.first * pixel);
        adler_row(adler, scratch->row + span.first, span.end - span.first, encoding->bytes_per_pixel);
        adler_zeros(adler, (size_t)(width - span.end) * pixel);
        deflate_row(scratch, span.first, span.end);
        above = here;
    }
    return deflate_write(scratch, out);
}

static void encode_strip(void *user, size_t index, int thread)
{
    struct png_encoding *encoding = user;
    const int strip = encoding->first + (int)index;
    struct png_strip *done = &encoding->done[index];
    uint8_t *out = encoding->out + index * encoding->room;
    done->adler = (struct adler_part){0};
    done->size = 0;
    if (!call_should_continue(&encoding->call))
        return;
    size_t size = 0;
    if (strip == 0) {
        // zlib's header (RFC 1950): deflate, a window of 32 KiB, the fastest level or the slowest.
        out[8] = 0x78;
        out[9] = encoding->best ? 0xDA : 0x01;
        size = 2;
    }
    size += encoding->best ? png_best_strip(encoding, strip, thread, &done->adler, out + 8 + size)
                           : quick_strip(encoding, strip, thread, &done->adler, out + 8 + size);
    done->size = png_close_chunk(&encoding->crc, "IDAT", out, size);
}
static size_t put_head(const struct png_encoding *encoding, bool raw, uint8_t *out)
{
    static const uint8_t signature[8] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
    static const uint8_t intent = 0; // perceptual
    static const char software[] = "Software\0lambent";
    uint8_t header[13] = {0}, *at = out;
    memcpy(at, signature, sizeof signature);
    at += sizeof signature;
    put_u32(header, (uint32_t)encoding->image->width);
    put_u32(header + 4, (uint32_t)encoding->image->height);
    header[8] = 8;                                      // bits
    header[9] = encoding->bytes_per_pixel == 4 ? 6 : 2; // RGBA or RGB
    at += put_chunk(&encoding->crc, "IHDR", header, sizeof header, at);
    if (!raw)
        at += put_chunk(&encoding->crc, "sRGB", &intent, 1, at);
    at += put_chunk(&encoding->crc, "tEXt", software, sizeof software - 1, at);
    return (size_t)(at - out);
}

// The last block, empty with fixed codes, and the checksum.
static size_t put_tail(const struct png_encoding *encoding, const struct adler_part *adler, uint8_t *out)
{
    uint8_t end[6] = {3, 0};
    put_u32(end + 2, adler_value(adler));
    size_t size = put_chunk(&encoding->crc, "IDAT", end, sizeof end, out);
    return size + put_chunk(&encoding->crc, "IEND", NULL, 0, out + size);
}

enum { HEAD_ROOM = 128, TAIL_ROOM = 6 + 2 * PNG_CHUNK };

// Memory that lives while the file is made. Bounded: per thread about 12 bytes for each pixel of a strip.
static bool get_scratch(struct png_encoding *encoding, bool best, struct pool *pool, struct arena *arena,
                        lam_error *error)
{
    const int threads = pool_threads(pool);
    const int width = encoding->image->width;
    const int batch = encoding->strips < BATCH_STRIPS ? encoding->strips : BATCH_STRIPS;
    encoding->done = arena_array(arena, (size_t)batch, sizeof *encoding->done);
    encoding->zeros = arena_alloc_zeroed(arena, (size_t)width * 4);
    if (encoding->done && encoding->zeros && best)
        return png_best_start(encoding, pool, arena, error);
    encoding->scratch = arena_array(arena, (size_t)threads, sizeof *encoding->scratch);
    bool ok = encoding->scratch && encoding->done && encoding->zeros;
    for (int i = 0; ok && i < threads; i++)
        ok = deflate_make(&encoding->scratch[i], arena, width, encoding->rows, encoding->bytes_per_pixel);
    return ok || fail_memory(error, (size_t)threads * deflate_scratch(width, encoding->rows));
}

// Strips are made at a distance that fits the worst case, then moved together. Pages that were not reached
// are never touched, so the room costs address space only.
static bool encode_strips(struct png_encoding *encoding, bool raw, struct pool *pool, lam_bytes *out, lam_error *error)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    struct adler_part adler = {0};
    for (encoding->first = 0; encoding->first < encoding->strips; encoding->first += BATCH_STRIPS) {
        int left = encoding->strips - encoding->first, count = left < BATCH_STRIPS ? left : BATCH_STRIPS;
        size_t wanted = (size ? size : HEAD_ROOM) + (size_t)count * encoding->room + TAIL_ROOM;
        if (!call_should_continue(&encoding->call)) {
            free(bytes);
            return call_error(&encoding->call, error);
        }
        uint8_t *more = realloc(bytes, wanted);
        if (!more) {
            free(bytes);
            return fail_memory(error, wanted);
        }
        bytes = more;
        if (size == 0)
            size = put_head(encoding, raw, bytes);
        encoding->out = bytes + size;
        pool_run(pool, (size_t)count, encode_strip, encoding);
        for (int i = 0; i < count; i++) {
            memmove(bytes + size, encoding->out + (size_t)i * encoding->room, encoding->done[i].size);
            size += encoding->done[i].size;
            adler_join(&adler, &encoding->done[i].adler);
        }
    }
    if (!call_should_continue(&encoding->call)) {
        free(bytes);
        return call_error(&encoding->call, error);
    }
    size += put_tail(encoding, &adler, bytes + size);
    uint8_t *fitted = realloc(bytes, size);
    *out = (lam_bytes){fitted ? fitted : bytes, size};
    return true;
}

bool png_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
               lam_error *error)
{
    struct png_encoding encoding = {.image = image, .bytes_per_pixel = 4, .mask = 0xFFFFFFFFu};
    call_start(&encoding.call, params->control);
    const bool best = params->compress == LAM_COMPRESS_BEST;
    encoding.rows = (best ? PNG_BEST_PIXELS : STRIP_PIXELS) / image->width;
    if (encoding.rows < 1)
        encoding.rows = 1;
    if (encoding.rows > image->height)
        encoding.rows = image->height;
    encoding.strips = (image->height + encoding.rows - 1) / encoding.rows;
    if (encoding.strips == 1)
        pool = NULL;
    look_for_translucent(&encoding, 0, 0); // mostly the first pixel is, and then nobody needs to be woken
    if (!encoding.translucent)
        pool_run(pool, (size_t)encoding.strips, look_for_translucent, &encoding);
    if (!encoding.translucent) {
        encoding.bytes_per_pixel = 3;
        encoding.mask = 0x00FFFFFFu;
    }
    encoding.room =
        PNG_CHUNK + 2 +
        (best ? png_best_room(&encoding) : deflate_room(image->width, encoding.rows, encoding.bytes_per_pixel));
    crc_tables_make(&encoding.crc);

    struct arena arena;
    arena_start(&arena, NULL);
    bool ok =
        get_scratch(&encoding, best, pool, &arena, error) && encode_strips(&encoding, params->raw, pool, out, error);
    arena_free(&arena);
    return ok;
}
