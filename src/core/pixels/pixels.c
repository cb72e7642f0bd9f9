// pixels.c: converts rows of pixels between formats.
#include "pixels.h"

#include "fail.h"

#include <string.h>

#define LANES 8
#include "encoding.h"

static const struct {
    int bytes;
    bool alpha;
} formats[] = {
    [LAM_RGBA8] = {4, true}, [LAM_RGBA32F] = {16, true}, [LAM_BGRA8] = {4, true},
    [LAM_RGB8] = {3, false}, [LAM_GREY8] = {1, false},   [LAM_RGB32F] = {12, false},
};
enum { FORMATS = sizeof formats / sizeof *formats };

size_t pixel_bytes(lam_pixel_format format) { return (size_t)formats[format].bytes; }
bool format_has_alpha(lam_pixel_format format) { return formats[format].alpha; }

bool image_check(const lam_image *image, const char *what, lam_error *error)
{
    if (!image || !image->pixels)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the picture is missing or has no pixels", what);
    if (image->width < 1 || image->width > 65535 || image->height < 1 || image->height > 65535)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the picture has %d×%d pixels, expected 1 to 65535 each way", what,
                    image->width, image->height);
    if ((unsigned)image->format >= FORMATS)
        return fail(error, LAM_BAD_ARGUMENT, "%s: pixel format %d is not one of lam_pixel_format", what,
                    (int)image->format);
    int64_t row = (int64_t)image->width * formats[image->format].bytes, stride = image->stride;
    if (stride && stride < row && -stride < row)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the stride is %lld bytes, expected at least the %lld of a row", what,
                    (long long)stride, (long long)row);
    if (format_is_float(image->format) && (stride % 4 != 0 || (uintptr_t)image->pixels % 4 != 0))
        return fail(error, LAM_BAD_ARGUMENT, "%s: pixels of floats, expected an address and a stride divisible by 4",
                    what);
    return check_reserved(what, image, error);
}

void pixels_to_working(lam_pixel_format format, const void *from, int count, void *to)
{
    const uint8_t *in = from;
    uint8_t *out = to;
    if (format == working_format(format)) {
        memcpy(to, from, (size_t)count * pixel_bytes(format));
    } else if (format == LAM_RGB32F) {
        const float one = 1.0f;
        for (int i = 0; i < count; i++, in += 12, out += 16) {
            memcpy(out, in, 12);
            memcpy(out + 12, &one, 4);
        }
    } else {
        static const uint8_t channel[][3] = {[LAM_BGRA8] = {2, 1, 0}, [LAM_RGB8] = {0, 1, 2}, [LAM_GREY8] = {0, 0, 0}};
        int bytes = formats[format].bytes;
        for (int i = 0; i < count; i++, in += bytes, out += 4) {
            for (int c = 0; c < 3; c++)
                out[c] = in[channel[format][c]];
            out[3] = bytes == 4 ? in[3] : 255;
        }
    }
}

// Returns the BT.709 luminance. If r = g = b, the luminance is exactly r.
static num luminance(num r, num g, num b) { return g + 0.2126f * (r - g) + 0.0722f * (b - g); }

static void to_grey(bool raw, const uint8_t *from, int count, uint8_t *to)
{
    for (int x = 0; x < count; x += LANES) {
        int some = count - x < LANES ? count - x : LANES;
        float channel[3][LANES] = {{0}};
        int32_t grey[LANES];
        for (int i = 0; i < some; i++)
            for (int c = 0; c < 3; c++)
                channel[c][i] = (float)from[4 * (x + i) + c] * (1.0f / 255.0f);
        num r = num_load(channel[0]), g = num_load(channel[1]), b = num_load(channel[2]);
        num y = raw ? luminance(r, g, b) : srgb_encode(luminance(srgb_decode(r), srgb_decode(g), srgb_decode(b)));
        inum_store(grey, byte_of(y));
        for (int i = 0; i < some; i++)
            to[x + i] = (uint8_t)grey[i];
    }
}

void pixels_from_working(lam_pixel_format format, bool raw, const void *from, int count, void *to)
{
    const uint8_t *in = from;
    uint8_t *out = to;
    if (format == LAM_GREY8) {
        to_grey(raw, from, count, to);
    } else if (format == LAM_RGB32F) {
        for (int i = 0; i < count; i++, in += 16, out += 12)
            memcpy(out, in, 12);
    } else if (format == LAM_RGB8) {
        for (int i = 0; i < count; i++, in += 4, out += 3)
            memcpy(out, in, 3);
    } else if (format == LAM_BGRA8) {
        for (int i = 0; i < count; i++, in += 4, out += 4) {
            const uint8_t pixel[4] = {in[2], in[1], in[0], in[3]};
            memcpy(out, pixel, 4);
        }
    } else {
        memcpy(to, from, (size_t)count * pixel_bytes(format));
    }
}
