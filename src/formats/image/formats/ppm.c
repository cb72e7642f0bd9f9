// ppm.c: reads and writes binary PPM (P6), three bytes per pixel, with the picture composited over a background.
#include "codec.h"
#include "compose.h"
#include "fail.h"
#include "netpbm.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
