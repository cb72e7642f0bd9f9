// netpbm.c: reads and writes binary PPM (P6) and PFM (Debevec's portable float map).
#include "codec.h"
#include "compose.h"
#include "fail.h"
#include "number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct netpbm_header {
    int width, height; // 1 … 65535
    double last;       // PPM: the largest value; PFM: the scale, whose sign states the byte order
    size_t pixels;     // the offset of the pixels
};

static bool is_space(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static const uint8_t *skip_space(const uint8_t *at, const uint8_t *end)
{
    while (at < end && (is_space(*at) || *at == '#')) {
        if (*at == '#')
            while (at < end && *at != '\n')
                at++;
        else
            at++;
    }
    return at;
}

// Reads the header of a file whose first two bytes have been checked. The header consists of the width, the height and
// one more number, followed by one white-space character. The numbers are separated by white space and by comments,
// from '#' to the end of the line. `title` is the format's name.
static bool netpbm_read_header(const struct picture_file *file, const char *title, struct netpbm_header *header,
                               lam_error *error)
{
    static const char *const words[3] = {"width", "height", "number after the height"};
    const uint8_t *bytes = file->bytes, *at = bytes + 2, *end = bytes + file->size;
    const char *name = file->name;
    double values[3];
    for (int i = 0; i < 3; i++) {
        const uint8_t *start = skip_space(at, end);
        at = start > at ? number_double(start, end, &values[i]) : NULL;
        if (!at || at == end || !is_space(*at))
            return fail(error, LAM_CANNOT_READ, "%s: byte %zu: no %s in the %s header", name, (size_t)(start - bytes),
                        words[i], title);
    }
    for (int i = 0; i < 2; i++) {
        if (values[i] > 65535)
            return fail(error, LAM_LIMIT, "%s: the %s header has a %s of %g, expected at most 65535", name, title,
                        words[i], values[i]);
        if (!(values[i] >= 1) || values[i] != (int)values[i])
            return fail(error, LAM_CANNOT_READ, "%s: the %s header has a %s of %g, expected 1 to 65535", name, title,
                        words[i], values[i]);
    }
    *header = (struct netpbm_header){(int)values[0], (int)values[1], values[2], (size_t)(at - bytes) + 1};
    return true;
}

// --- reads and writes binary PPM (P6), three bytes per pixel, with the picture composited over a background.

static const char remark[] = "P6\n# lambent\n";

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

    struct compose compose;
    compose_start(&compose, params);
    compose_row(&compose, image->pixels, (size_t)pixels, bytes + head);
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
    .written = "8 bits, sRGB, over the background",
    .pixels = LAM_RGBA8,
    .write = ppm_write,
    .probe = ppm_probe,
    .read = ppm_read,
    .ours = ppm_ours,
};

// --- reads and writes PFM files (Debevec's portable float map). A PFM file consists of a header of three lines, and of
// floats, with the bottom row first.
//
// The header contains "PF" ("Pf" with one number for each pixel), the width and the height, and a number. The sign of this number states the byte order:
// negative means little-endian. The absolute value of the number is the scale. Programs do not agree about the scale,
// so Lambent writes 1 and ignores the scale when it reads a file. PFM has neither alpha nor comments, so the file
// cannot name the program that wrote it.

static bool pfm_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                      lam_error *error)
{
    (void)pool;
    char header[40];
    const size_t each = params->single ? sizeof(float) : 3 * sizeof(float);
    size_t head = (size_t)snprintf(header, sizeof header, "P%c\n%d %d\n-1.0\n", params->single ? 'f' : 'F',
                                   image->width, image->height);
    uint64_t wanted = (uint64_t)image->width * (uint64_t)image->height * each + head;
    uint8_t *bytes = wanted <= SIZE_MAX ? malloc((size_t)wanted) : NULL;
    if (!bytes)
        return fail_memory(error, (size_t)wanted);
    memcpy(bytes, header, head);
    uint8_t *at = bytes + head;
    for (int y = image->height - 1; y >= 0; y--) {
        const float *pixel = (const float *)image->pixels + (size_t)y * (size_t)image->width * 4;
        for (int x = 0; x < image->width; x++, pixel += 4, at += each)
            memcpy(at, pixel, each);
    }
    *out = (lam_bytes){bytes, (size_t)wanted};
    return true;
}

static bool pfm_probe(const uint8_t *bytes, size_t size)
{
    return size >= 3 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') &&
           (bytes[2] == '\n' || bytes[2] == '\r' || bytes[2] == ' ' || bytes[2] == '\t');
}

static float float_at(const uint8_t *at, bool little)
{
    uint32_t word = little ? at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24
                           : at[3] | (uint32_t)at[2] << 8 | (uint32_t)at[1] << 16 | (uint32_t)at[0] << 24;
    float value;
    memcpy(&value, &word, 4);
    return value;
}

static bool pfm_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    const uint8_t *bytes = file->bytes;
    size_t size = file->size;
    struct netpbm_header header;
    if (!netpbm_read_header(file, "PFM", &header, error))
        return false;
    if (header.last == 0 || header.last != header.last)
        return fail(error, LAM_CANNOT_READ, "%s: the PFM header has a scale of %g, expected a number above or below 0",
                    file->name, header.last);
    const size_t channels = bytes[1] == 'F' ? 3 : 1;
    const bool little = header.last < 0;
    uint64_t wanted = (uint64_t)header.width * (uint64_t)header.height * channels * 4;
    if (!picture_size_check(file, (uint32_t)header.width, (uint32_t)header.height, error))
        return false;
    if (wanted > size - header.pixels)
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, but its %d×%d floats take up to byte %llu",
                    file->name, size, header.width, header.height, (unsigned long long)(wanted + header.pixels));
    if (!picture_make(file, (uint32_t)header.width, (uint32_t)header.height, LAM_RGBA32F, image, error))
        return false;
    image->no_alpha = true;
    const uint8_t *at = bytes + header.pixels;
    for (int y = header.height - 1; y >= 0; y--) {
        if (!picture_continues(file, y, error)) {
            picture_free(file->call, image);
            return false;
        }
        float *pixel = (float *)image->pixels + (size_t)y * (size_t)header.width * 4;
        for (int x = 0; x < header.width; x++, pixel += 4, at += 4 * channels) {
            for (size_t channel = 0; channel < 3; channel++)
                pixel[channel] = float_at(at + (channels == 3 ? 4 * channel : 0), little);
            pixel[3] = 1.0f;
        }
    }
    return true;
}

const struct codec codec_pfm = {
    .name = "pfm",
    .title = "PFM",
    .written = "floats, linear, premultiplied by alpha",
    .pixels = LAM_RGBA32F,
    .write = pfm_write,
    .probe = pfm_probe,
    .read = pfm_read,
};
