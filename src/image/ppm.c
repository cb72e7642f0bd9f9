// ppm.c: binary PPM (P6), three bytes a pixel, the picture over a background.
#include "codec.h"
#include "fail.h"
#include "netpbm.h"
#include "srgb.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char remark[] = "P6\n# lambent\n";

// Composes channels over a background: in linear light, unless the numbers are raw.
struct over {
    double linear[256]; // of a byte
    double from[256];   // for i > 0 the smallest linear number that is rounded to byte i: that of (i − ½)/255
};

static void make_over(struct over *over, bool raw)
{
    for (int i = 0; i < 256; i++) {
        over->linear[i] = raw ? i / 255.0 : srgb_linear(i / 255.0);
        over->from[i] = raw ? (i - 0.5) / 255.0 : srgb_linear((i - 0.5) / 255.0);
    }
}

// The nearest byte, by bisection; numbers outside 0…1 are clamped, NaN gives 0.
static uint8_t byte_of(const struct over *over, double linear)
{
    int byte = 0;
    for (int step = 128; step > 0; step /= 2)
        if (linear >= over->from[byte + step])
            byte += step;
    return (uint8_t)byte;
}

static uint8_t lay(const struct over *over, uint8_t color, uint8_t alpha, double background)
{
    double share = alpha / 255.0;
    return byte_of(over, over->linear[color] * share + background * (1.0 - share));
}

static bool ppm_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                      lam_error *error)
{
    (void)pool;
    char header[64];
    size_t head = (size_t)snprintf(header, sizeof header, "%s%d %d\n255\n", remark, image->width, image->height);
    uint64_t pixels = (uint64_t)image->width * (uint64_t)image->height, wanted = pixels * 3 + head;
    uint8_t *bytes = wanted <= SIZE_MAX ? malloc((size_t)wanted) : NULL;
    if (!bytes)
        return fail_memory(error, (size_t)wanted);
    memcpy(bytes, header, head);

    const double background[3] = {(double)params->background.r, (double)params->background.g,
                                  (double)params->background.b};
    struct over over;
    make_over(&over, params->raw);
    uint8_t clear[3];
    for (int channel = 0; channel < 3; channel++)
        clear[channel] = byte_of(&over, background[channel]);
    const uint8_t *pixel = image->pixels;
    uint8_t *at = bytes + head;
    for (uint64_t i = 0; i < pixels; i++, pixel += 4, at += 3)
        for (int channel = 0; channel < 3; channel++)
            at[channel] = pixel[3] == 255 ? pixel[channel] // unchanged
                          : pixel[3] == 0 ? clear[channel]
                                          : lay(&over, pixel[channel], pixel[3], background[channel]);
    *out = (lam_bytes){bytes, (size_t)wanted};
    return true;
}

static bool ppm_probe(const uint8_t *bytes, size_t size)
{
    return size >= 3 && bytes[0] == 'P' && bytes[1] == '6' &&
           (bytes[2] == '\n' || bytes[2] == '\r' || bytes[2] == ' ' || bytes[2] == '\t' || bytes[2] == '#');
}

static bool ppm_ours(const uint8_t *bytes, size_t size)
{
    return size >= sizeof remark - 1 && memcmp(bytes, remark, sizeof remark - 1) == 0;
}

static bool ppm_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    const uint8_t *bytes = file->bytes;
    size_t size = file->size;
    struct netpbm_header header;
    if (!netpbm_read_header(file, "PPM", &header, error))
        return false;
    if (header.last != 255)
        return fail(error, LAM_UNSUPPORTED, "%s: PPM with a largest value of %g, expected 255", file->name,
                    header.last);
    uint64_t pixels = (uint64_t)header.width * (uint64_t)header.height;
    if (!picture_size_check(file, (uint32_t)header.width, (uint32_t)header.height, error))
        return false;
    if (pixels * 3 > size - header.pixels)
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, but its %d×%d pixels take up to byte %llu",
                    file->name, size, header.width, header.height, (unsigned long long)(pixels * 3 + header.pixels));
    if (!picture_make(file, (uint32_t)header.width, (uint32_t)header.height, LAM_RGBA8, image, error))
        return false;
    const uint8_t *at = bytes + header.pixels;
    uint8_t *pixel = image->pixels;
    for (int y = 0; y < header.height; y++) {
        if (!picture_continues(file, y, error)) {
            picture_free(file->call, image);
            return false;
        }
        for (int x = 0; x < header.width; x++, pixel += 4, at += 3) {
            memcpy(pixel, at, 3);
            pixel[3] = 255;
        }
    }
    return true;
}

const struct codec codec_ppm = {
    .name = "ppm",
    .title = "PPM",
    .pixels = LAM_RGBA8,
    .write = ppm_write,
    .probe = ppm_probe,
    .read = ppm_read,
    .ours = ppm_ours,
};
