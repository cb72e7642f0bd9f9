// apng.c: writes animated PNG: https://www.w3.org/TR/png-3/ (acTL, fcTL, fdAT).
//
// Each frame is encoded immediately, as a PNG of the smallest rectangle that contains all changes since the previous
// frame, with as few channels as possible. All frames of a file must have the same colour type, which is not known
// until the last frame. Frames with fewer channels are then decoded and encoded again. The chunks of these PNGs become
// the chunks of the animation.
#include "animation.h"
#include "codec.h"
#include "fail.h"
#include "pixels.h"
#include "png_encoding.h"

#include <stdlib.h>
#include <string.h>

enum { SIGNATURE = 8, CHUNK_BYTES = 12, CONTROL_BYTES = 26, SEQUENCE_BYTES = 4 };

struct box {
    int x, y, width, height;
};

struct apng_frame {
    lam_bytes png; // the PNG of the box
    struct box box;
    int channels; // enum png_channels
};

struct apng {
    struct animation_settings settings;
    lam_image before; // the previous frame; empty before the first frame
    struct apng_frame *frames;
    int count, capacity;
    uint64_t held; // bytes of the frames
};

static void apng_free(void *state)
{
    struct apng *apng = state;
    for (int i = 0; i < apng->count; i++)
        lam_bytes_free(&apng->frames[i].png);
    free(apng->frames);
    lam_image_free(&apng->before);
    free(apng);
}

static void *apng_start(const struct animation_settings *settings, lam_error *error)
{
    struct apng *apng = calloc(1, sizeof *apng);
    if (!apng)
        return fail_memory(error, sizeof *apng), NULL;
    apng->settings = *settings;
    return apng;
}

// Returns the smallest box that contains all differences between two pictures, or a box of one pixel if the pictures
// are equal.
static struct box changed_box(const lam_image *a, const lam_image *b)
{
    const size_t row = 4 * (size_t)a->width;
    const uint32_t *p = a->pixels, *q = b->pixels;
    int top = 0, bottom = a->height, left = a->width, right = 0;
    while (top < bottom && memcmp(p + (size_t)top * (size_t)a->width, q + (size_t)top * (size_t)a->width, row) == 0)
        top++;
    while (bottom > top &&
           memcmp(p + (size_t)(bottom - 1) * (size_t)a->width, q + (size_t)(bottom - 1) * (size_t)a->width, row) == 0)
        bottom--;
    if (top == bottom)
        return (struct box){0, 0, 1, 1};
    for (int y = top; y < bottom; y++) {
        const uint32_t *u = p + (size_t)y * (size_t)a->width, *v = q + (size_t)y * (size_t)a->width;
        for (int x = 0; x < left; x++)
            if (u[x] != v[x])
                left = x;
        for (int x = a->width; x > right; x--)
            if (u[x - 1] != v[x - 1])
                right = x;
    }
    return (struct box){left, top, right - left, bottom - top};
}

static bool cut(const lam_image *from, struct box box, lam_image *out, lam_error *error)
{
    if (!lam_image_make(out, box.width, box.height, LAM_RGBA8, error))
        return false;
    for (int y = 0; y < box.height; y++)
        memcpy(image_row(out, y), (const uint8_t *)image_row(from, box.y + y) + 4 * (size_t)box.x,
               4 * (size_t)box.width);
    return true;
}

static bool remember(struct apng *apng, const lam_image *frame, lam_error *error)
{
    if (!apng->before.pixels)
        return image_copy(frame, &apng->before, error);
    memcpy(apng->before.pixels, frame->pixels, 4 * (size_t)frame->width * (size_t)frame->height);
    return true;
}

static bool apng_add(void *state, const lam_image *frame, const lam_save_params *params, struct pool *pool,
                     lam_error *error)
{
    struct apng *apng = state;
    if (apng->count == apng->capacity) {
        const int capacity = apng->capacity ? 2 * apng->capacity : 64;
        struct apng_frame *larger = realloc(apng->frames, (size_t)capacity * sizeof *larger);
        if (!larger)
            return fail_memory(error, (size_t)capacity * sizeof *larger);
        apng->frames = larger;
        apng->capacity = capacity;
    }
    struct apng_frame *added = &apng->frames[apng->count];
    *added = (struct apng_frame){.box = {0, 0, frame->width, frame->height}};
    lam_image part = {0};
    if (apng->count > 0)
        added->box = changed_box(&apng->before, frame);
    bool ok = cut(frame, added->box, &part, error) &&
              png_write_channels(&part, params, pool, &added->channels, &added->png, error) &&
              remember(apng, frame, error);
    lam_image_free(&part);
    if (ok) {
        apng->count++;
        apng->held += sizeof *added + added->png.size;
    } else {
        lam_bytes_free(&added->png);
    }
    return ok;
}

static uint64_t apng_held(const void *state) { return ((const struct apng *)state)->held; }

// Encodes a frame again, with more channels.
static bool widen(struct apng_frame *frame, int channels, const lam_save_params *params, lam_error *error)
{
    const struct picture_file file = {.bytes = frame->png.data, .size = frame->png.size, .name = "frame"};
    lam_image image = {0};
    lam_bytes wider = {0};
    bool ok = codec_png.read(&file, &image, error);
    ok = ok && png_write_channels(&image, params, NULL, &channels, &wider, error);
    lam_image_free(&image);
    if (ok) {
        lam_bytes_free(&frame->png);
        frame->png = wider;
        frame->channels = channels;
    }
    return ok;
}

// --- the file

struct writer {
    uint8_t *bytes; // allocated with malloc
    size_t size;
    struct crc_tables crc;
    uint32_t sequence;
};

static void append(struct writer *writer, const void *bytes, size_t size)
{
    memcpy(writer->bytes + writer->size, bytes, size);
    writer->size += size;
}

static uint8_t *next_chunk_data(struct writer *writer) { return writer->bytes + writer->size + 8; }

static void close_chunk(struct writer *writer, const char *type, size_t size)
{
    writer->size += png_close_chunk(&writer->crc, type, writer->bytes + writer->size, size);
}

static void put_u16(uint8_t *at, uint32_t value)
{
    at[0] = (uint8_t)(value >> 8);
    at[1] = (uint8_t)value;
}

static void put_animation_control(struct writer *writer, const struct apng *apng)
{
    png_put_u32(next_chunk_data(writer), (uint32_t)apng->count);
    png_put_u32(next_chunk_data(writer) + 4, (uint32_t)apng->settings.loops);
    close_chunk(writer, "acTL", 8);
}

// Writes the duration of a frame as a fraction of two 16-bit numbers. The duration is exact for a whole number of
// frames per second. Otherwise the rate is rounded to a thousandth of a frame per second or, above 65 frames per
// second, to a hundredth.
static void put_delay(double frames_per_second, uint8_t out[4])
{
    const bool whole = frames_per_second == (double)(int)frames_per_second;
    const int parts = whole ? 1 : frames_per_second < 65 ? 1000 : 100;
    put_u16(out, (uint32_t)parts);
    put_u16(out + 2, (uint32_t)(frames_per_second * parts + 0.5));
}

static void put_frame_control(struct writer *writer, const struct apng *apng, const struct box *box)
{
    uint8_t *data = next_chunk_data(writer);
    png_put_u32(data, writer->sequence++);
    png_put_u32(data + 4, (uint32_t)box->width);
    png_put_u32(data + 8, (uint32_t)box->height);
    png_put_u32(data + 12, (uint32_t)box->x);
    png_put_u32(data + 16, (uint32_t)box->y);
    put_delay(apng->settings.frames_per_second, data + 20);
    data[24] = 0; // APNG_DISPOSE_OP_NONE keeps the frame
    data[25] = 0; // APNG_BLEND_OP_SOURCE: replace the previous pixels, alpha included
    close_chunk(writer, "fcTL", CONTROL_BYTES);
}

// Returns the maximum number of bytes that put_frame appends for a frame. The number includes a sequence number for
// each chunk of the frame. It also includes one chunk that is not closed yet, and the chunks of the animation.
static size_t frame_bytes(const struct apng_frame *frame)
{
    const uint8_t *at = frame->png.data, *end = at + frame->png.size;
    size_t bytes = frame->png.size + (size_t)3 * CHUNK_BYTES + CONTROL_BYTES + 8;
    for (at += SIGNATURE; at < end; at += png_u32_at(at) + CHUNK_BYTES)
        bytes += SEQUENCE_BYTES;
    return bytes;
}

// Copies the chunks of a frame's PNG. Also copies the chunks before the picture if the frame is the first.
static void put_frame(struct writer *writer, const struct apng *apng, int index)
{
    const struct apng_frame *frame = &apng->frames[index];
    const uint8_t *at = frame->png.data, *end = at + frame->png.size;
    if (index == 0)
        append(writer, at, SIGNATURE);
    bool pictured = false;
    for (at += SIGNATURE; at < end;) {
        const size_t size = png_u32_at(at), whole = size + CHUNK_BYTES;
        const bool is_data = memcmp(at + 4, "IDAT", 4) == 0, is_end = memcmp(at + 4, "IEND", 4) == 0;
        if (is_data && !pictured) {
            if (index == 0)
                put_animation_control(writer, apng);
            put_frame_control(writer, apng, &frame->box);
            pictured = true;
        }
        if (is_data && index > 0) {
            png_put_u32(next_chunk_data(writer), writer->sequence++);
            memcpy(next_chunk_data(writer) + SEQUENCE_BYTES, at + 8, size);
            close_chunk(writer, "fdAT", SEQUENCE_BYTES + size);
        } else if (is_data || (index == 0 && !is_end)) {
            append(writer, at, whole);
        }
        at += whole;
    }
}

// Encodes the frames with fewer channels again, so that all frames have the same channels. Computes the size of the
// file.
static bool unify(struct apng *apng, const lam_save_params *params, struct call_control *call, size_t *bytes,
                  lam_error *error)
{
    const size_t again = (size_t)8 * (size_t)apng->settings.width * (size_t)apng->settings.height;
    int channels = 0;
    if (!call_charge(call, apng->held) || !call_charge(call, again)) // the pixels of one frame, and its new encoding
        return call_memory_error(call, again, error);
    for (int i = 0; i < apng->count; i++)
        channels |= apng->frames[i].channels;
    *bytes = CHUNK_BYTES;
    for (int i = 0; i < apng->count; i++) {
        const size_t before = apng->frames[i].png.size;
        if (!call_should_continue(call))
            return call_error(call, error);
        if (apng->frames[i].channels != channels && !widen(&apng->frames[i], channels, params, error))
            return false;
        const size_t after = apng->frames[i].png.size;
        if (after > before && !call_charge(call, after - before))
            return call_memory_error(call, after - before, error);
        *bytes += frame_bytes(&apng->frames[i]);
    }
    return true;
}

static bool apng_finish(void *state, const lam_save_params *params, lam_bytes *out, lam_error *error)
{
    struct apng *apng = state;
    struct writer writer = {0};
    struct call_control call;
    size_t bytes = 0;
    call_start(&call, params->control);
    if (!unify(apng, params, &call, &bytes, error))
        return false;
    writer.bytes = call_charge(&call, bytes) ? malloc(bytes) : NULL;
    if (!writer.bytes)
        return call_memory_error(&call, bytes, error);
    crc_tables_make(&writer.crc);
    for (int i = 0; i < apng->count; i++) {
        put_frame(&writer, apng, i);
        lam_bytes_free(&apng->frames[i].png);
    }
    close_chunk(&writer, "IEND", 0);
    uint8_t *fitted = realloc(writer.bytes, writer.size);
    *out = (lam_bytes){fitted ? fitted : writer.bytes, writer.size};
    return true;
}

const struct animation_codec animation_png = {
    .start = apng_start, .add = apng_add, .finish = apng_finish, .held = apng_held, .free = apng_free};
