// png_write.c: writes PNG files: grey, grey and alpha, RGB or RGBA, whichever is the smallest exact representation.
//
// The picture is divided into strips of rows, whose height depends only on the width. Each strip is filtered and
// compressed separately (png_fast.c, png_best.c) and becomes one IDAT chunk with its own CRC. Any thread can process
// any strip, and the bytes do not depend on the threads. Only the Adler-32 checksums of the strips are combined at the
// end.
#include "codec.h"
#include "fail.h"
#include "pixels.h"
#include "png_encoding.h"

#include <stdlib.h>
#include <string.h>

enum {
    BATCH_STRIPS = 256, // strips per batch; a batch reserves memory for the worst case
    CHUNK_BYTES = 12,   // a chunk's length, type and CRC
    ZLIB_HEADER = 2,    // bytes in the chunk of the first strip
    HEAD_BYTES = 384,   // the maximum size of the header
    TAIL_BYTES = 6 + 2 * CHUNK_BYTES,
};

struct png_strip {
    struct adler_part adler;
    size_t size; // size of the strip's chunk; 0 if the strip was not encoded
};

struct png_writer {
    struct png_encoding encoding;
    const struct png_method *method;
    struct crc_tables crc;
    int channels;           // enum png_channels; accessed atomically
    bool wide;              // grey with 16 bits: red has the high byte, alpha the low byte
    int first;              // first strip of this batch
    uint8_t *out;           // the output of this batch, chunk_capacity bytes for each strip
    struct png_strip *done; // one for each strip of a batch
};

static size_t chunk_capacity(const struct png_writer *writer)
{
    return CHUNK_BYTES + ZLIB_HEADER + writer->encoding.capacity;
}

void png_put_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

size_t png_close_chunk(const struct crc_tables *crc, const char *type, uint8_t *out, size_t size)
{
    png_put_u32(out, (uint32_t)size);
    memcpy(out + 4, type, 4);
    png_put_u32(out + 8 + size, crc_of(crc, out + 4, size + 4));
    return size + CHUNK_BYTES;
}

static size_t put_chunk(const struct crc_tables *crc, const char *type, const void *data, size_t size, uint8_t *out)
{
    if (size)
        memcpy(out + 8, data, size);
    return png_close_chunk(crc, type, out, size);
}

typedef uint32_t u32x4 __attribute__((vector_size(16)));
typedef u32x4 u32x4_memory __attribute__((aligned(1), may_alias));

// Returns the channels that these pixels need.
static int channels_of(const uint8_t *pixels, size_t count)
{
    u32x4 differ = {0}, all = ~differ;
    size_t i = 0;
    for (; i + 16 <= count; i += 16)
        for (size_t k = i; k < i + 16; k += 4) {
            const u32x4 four = *(const u32x4_memory *)(pixels + 4 * k);
            differ |= four ^ four >> 8; // compares red with green, and green with blue
            all &= four;
        }
    for (; i < count; i++) {
        uint32_t pixel;
        memcpy(&pixel, pixels + 4 * i, 4);
        differ[0] |= pixel ^ pixel >> 8;
        all[0] &= pixel;
    }
    const bool colored = (differ[0] | differ[1] | differ[2] | differ[3]) & 0xFFFF;
    const bool opaque = (all[0] & all[1] & all[2] & all[3]) >> 24 == 255;
    return (colored ? PNG_COLORED : 0) | (opaque ? 0 : PNG_TRANSLUCENT);
}

// Finds the spans of a strip's rows, and adds the channels that the pixels of the strip need. Pixels are skipped only
// if all channels are already needed, so the result does not depend on the order of the strips.
static void examine_strip(void *user, size_t index, int thread)
{
    (void)thread;
    struct png_writer *writer = user;
    const struct png_encoding *encoding = &writer->encoding;
    const int width = encoding->image->width, top = (int)index * encoding->rows;
    for (int y = top; y < top + png_strip_rows(encoding, (int)index); y++) {
        const uint8_t *row = png_pixel_row(encoding, y);
        const struct png_span span = encoding->spans[y] = png_span_of(row, width);
        const int known = __atomic_load_n(&writer->channels, __ATOMIC_RELAXED), count = span.end - span.first;
        if (known == PNG_ALL_CHANNELS)
            continue;
        const int found =
            channels_of(row + 4 * (size_t)span.first, (size_t)count) | (count < width ? PNG_TRANSLUCENT : 0);
        if (found & ~known)
            __atomic_fetch_or(&writer->channels, found, __ATOMIC_RELAXED);
    }
}

static void encode_strip(void *user, size_t index, int thread)
{
    struct png_writer *writer = user;
    const int strip = writer->first + (int)index;
    struct png_strip *done = &writer->done[index];
    uint8_t *out = writer->out + index * chunk_capacity(writer);
    *done = (struct png_strip){0};
    if (!call_should_continue(&writer->encoding.call))
        return;
    size_t header = 0;
    if (strip == 0) {
        // RFC 1950: deflate, a window of 32 KiB.
        out[8] = 0x78;
        out[9] = writer->method->zlib_flags;
        header = ZLIB_HEADER;
    }
    const size_t size = writer->method->strip(&writer->encoding, strip, thread, &done->adler, out + 8 + header);
    if (size)
        done->size = png_close_chunk(&writer->crc, "IDAT", out, header + size);
}

static size_t put_head(const struct png_writer *writer, const lam_save_params *params, uint8_t *out)
{
    static const uint8_t signature[8] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
    static const uint8_t color_types[5] = {0, 0, 4, 2, 6}; // indexed by bytes_per_pixel
    static const uint8_t intent = 0;                       // perceptual
    static const char software[] = "Software\0lambent";
    char comment[sizeof "Comment" + SAVE_COMMENT_MAX] = "Comment";
    uint8_t header[13] = {0}, *at = out;
    memcpy(at, signature, sizeof signature);
    at += sizeof signature;
    png_put_u32(header, (uint32_t)writer->encoding.image->width);
    png_put_u32(header + 4, (uint32_t)writer->encoding.image->height);
    header[8] = writer->wide ? 16 : 8; // bits
    header[9] = writer->wide ? 0 : color_types[writer->encoding.bytes_per_pixel];
    at += put_chunk(&writer->crc, "IHDR", header, sizeof header, at);
    if (!params->raw)
        at += put_chunk(&writer->crc, "sRGB", &intent, 1, at);
    at += put_chunk(&writer->crc, "tEXt", software, sizeof software - 1, at);
    if (params->comment) {
        const size_t length = strlen(params->comment);
        memcpy(comment + sizeof "Comment", params->comment, length);
        at += put_chunk(&writer->crc, "tEXt", comment, sizeof "Comment" + length, at);
    }
    return (size_t)(at - out);
}

// Writes the last block, which is empty and uses fixed codes, and then the checksum.
static size_t put_tail(const struct png_writer *writer, const struct adler_part *adler, uint8_t *out)
{
    uint8_t end[6] = {3, 0};
    png_put_u32(end + 2, adler_value(adler));
    size_t size = put_chunk(&writer->crc, "IDAT", end, sizeof end, out);
    return size + put_chunk(&writer->crc, "IEND", NULL, 0, out + size);
}

// Encodes the strips of a batch, and stores their chunks consecutively at bytes + *size. Each strip is first encoded at
// its own address, with space for the worst case. Unused pages are never accessed, so the reserved space needs only
// addresses, not memory.
static bool encode_batch(struct png_writer *writer, int count, struct pool *pool, uint8_t *bytes, size_t *size,
                         struct adler_part *adler, lam_error *error)
{
    writer->out = bytes + *size;
    pool_run(pool, (size_t)count, encode_strip, writer);
    if (!call_should_continue(&writer->encoding.call))
        return call_error(&writer->encoding.call, error);
    for (int i = 0; i < count; i++) {
        if (!writer->done[i].size)
            return fail_memory(error, chunk_capacity(writer));
        memmove(bytes + *size, writer->out + (size_t)i * chunk_capacity(writer), writer->done[i].size);
        *size += writer->done[i].size;
        adler_join(adler, &writer->done[i].adler);
    }
    return true;
}

static bool encode_strips(struct png_writer *writer, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                          lam_error *error)
{
    const int strips = writer->encoding.strips;
    uint8_t *bytes = NULL;
    size_t size = 0;
    struct adler_part adler = {0};
    bool ok = true;
    for (writer->first = 0; ok && writer->first < strips; writer->first += BATCH_STRIPS) {
        const int left = strips - writer->first, count = left < BATCH_STRIPS ? left : BATCH_STRIPS;
        const size_t wanted = (size ? size : HEAD_BYTES) + (size_t)count * chunk_capacity(writer) + TAIL_BYTES;
        uint8_t *larger = realloc(bytes, wanted);
        if (!larger) {
            ok = fail_memory(error, wanted);
            break;
        }
        bytes = larger;
        if (size == 0)
            size = put_head(writer, params, bytes);
        ok = encode_batch(writer, count, pool, bytes, &size, &adler, error);
    }
    if (!ok) {
        free(bytes);
        return false;
    }
    size += put_tail(writer, &adler, bytes + size);
    uint8_t *fitted = realloc(bytes, size);
    *out = (lam_bytes){fitted ? fitted : bytes, size};
    return true;
}

static bool write_png(const lam_image *image, const lam_save_params *params, struct pool *pool, int *channels,
                      bool wide, lam_bytes *out, lam_error *error)
{
    struct png_writer writer = {
        .method = params->compress == LAM_COMPRESS_BEST ? &png_best : &png_fast, .channels = *channels, .wide = wide};
    struct png_encoding *encoding = &writer.encoding;
    encoding->image = image;
    call_start(&encoding->call, params->control);
    encoding->rows = writer.method->strip_pixels / image->width;
    if (encoding->rows < 1)
        encoding->rows = 1;
    if (encoding->rows > image->height)
        encoding->rows = image->height;
    encoding->strips = (image->height + encoding->rows - 1) / encoding->rows;
    if (encoding->strips == 1)
        pool = NULL;
    crc_tables_make(&writer.crc);

    struct arena arena;
    arena_start(&arena, NULL);
    const int batch = encoding->strips < BATCH_STRIPS ? encoding->strips : BATCH_STRIPS;
    const size_t height = (size_t)image->height, row_bytes = (size_t)image->width * 4;
    writer.done = arena_array(&arena, (size_t)batch, sizeof *writer.done);
    encoding->spans = arena_array(&arena, height, sizeof *encoding->spans);
    encoding->zeros = arena_alloc_zeroed(&arena, row_bytes);
    bool ok = writer.done && encoding->spans && encoding->zeros;
    if (ok)
        pool_run(pool, (size_t)encoding->strips, examine_strip, &writer);
    else
        fail_memory(error, (size_t)batch * sizeof *writer.done + height * sizeof *encoding->spans + row_bytes);
    *channels = writer.channels;
    encoding->bytes_per_pixel = (writer.channels & PNG_COLORED ? 3 : 1) + (writer.channels & PNG_TRANSLUCENT ? 1 : 0);
    ok = ok && writer.method->start(encoding, pool, &arena, error) && encode_strips(&writer, params, pool, out, error);
    if (writer.method->end)
        writer.method->end(encoding);
    arena_free(&arena);
    return ok;
}

bool png_write_channels(const lam_image *image, const lam_save_params *params, struct pool *pool, int *channels,
                        lam_bytes *out, lam_error *error)
{
    return write_png(image, params, pool, channels, false, out, error);
}

// Writes the first number of each pixel of a picture of floats with 16 bits (lam_save_params.single).
static bool write_single(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                         lam_error *error)
{
    lam_image bytes = {0};
    if (!lam_image_make(&bytes, image->width, image->height, LAM_RGBA8, error))
        return false;
    for (int y = 0; y < image->height; y++) {
        const float *from = image_row(image, y);
        uint8_t *to = image_row(&bytes, y);
        for (int x = 0; x < image->width; x++, from += 4, to += 4) {
            const float number = from[0] > 0 ? from[0] < 65535 ? from[0] : 65535 : 0; // NaN becomes 0
            const unsigned whole = (unsigned)(number + 0.5f);
            to[0] = to[1] = to[2] = (uint8_t)(whole >> 8);
            to[3] = (uint8_t)whole;
        }
    }
    int channels = PNG_TRANSLUCENT;
    bool ok = write_png(&bytes, params, pool, &channels, true, out, error);
    lam_image_free(&bytes);
    return ok;
}

bool png_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
               lam_error *error)
{
    int channels = 0;
    return params->single ? write_single(image, params, pool, out, error)
                          : write_png(image, params, pool, &channels, false, out, error);
}
