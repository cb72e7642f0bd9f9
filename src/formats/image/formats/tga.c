// tga.c: reads Truevision TGA files: palettes, true colour and grey, with 8, 15, 16, 24 and 32 bits, uncompressed or
// run-length encoded, with the first pixel in any corner. Truevision TGA File Format Specification, version 2.0 (1991).
//
// A TGA file has no magic number. Lambent therefore tries all other formats first, and then checks the whole header. In
// pixels of 32 bits, the fourth byte is used as alpha, even if the header declares 0 alpha bits, because many programs
// write such files. If the header declares 0 alpha bits and the fourth byte is 0 in all pixels, the byte is ignored.
#include "codec.h"
#include "fail.h"
#include "little_endian.h"

#include <string.h>

enum { HEADER = 18 };
enum kind { PALETTE = 1, COLOR = 2, GREY = 3, RUNS = 8 };

struct tga {
    const struct picture_file *file;
    uint32_t type, width, height;
    uint32_t kind;                      // PALETTE, COLOR or GREY
    uint32_t bits;                      // per pixel
    uint32_t first, colors, color_bits; // the palette: index of the first entry, number of entries, bits per entry
    uint32_t alpha_bits;
    bool runs, top_down, right_to_left;
    const uint8_t *palette;
};

static bool is_color_bits(uint32_t bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; }

// Parses the header. Returns false if the bytes are not a TGA header; `error` (may be NULL) then contains the reason.
static bool take_header(const struct picture_file *file, struct tga *tga, lam_error *error)
{
    const uint8_t *bytes = file->bytes;
    uint32_t map = bytes[1], flags = bytes[17];
    *tga = (struct tga){
        .file = file,
        .type = bytes[2],
        .kind = bytes[2] & 7,
        .runs = bytes[2] & RUNS,
        .first = u16_at(bytes + 3),
        .colors = map ? u16_at(bytes + 5) : 0,
        .color_bits = bytes[7],
        .width = u16_at(bytes + 12),
        .height = u16_at(bytes + 14),
        .bits = bytes[16],
        .alpha_bits = flags & 15,
        .right_to_left = flags & 16,
        .top_down = flags & 32,
    };
    if (tga->kind < PALETTE || tga->kind > GREY || tga->type > (RUNS | GREY))
        return fail(error, LAM_CANNOT_READ, "%s: TGA of type %u, expected 1, 2, 3, 9, 10 or 11", file->name, tga->type);
    if (map > 1 || (tga->kind == PALETTE && tga->colors == 0))
        return fail(error, LAM_CANNOT_READ, "%s: TGA of type %u with palette flag %u and a palette of %u", file->name,
                    tga->type, map, tga->colors);
    if (map && !is_color_bits(tga->color_bits))
        return fail(error, LAM_CANNOT_READ, "%s: TGA with a palette of %u bits, expected 15, 16, 24 or 32", file->name,
                    tga->color_bits);
    if (tga->kind == COLOR ? !is_color_bits(tga->bits) : tga->bits != 8)
        return fail(error, LAM_CANNOT_READ, "%s: TGA of type %u with %u bits a pixel, expected %s", file->name,
                    tga->type, tga->bits, tga->kind == COLOR ? "15, 16, 24 or 32" : "8");
    if (flags > 63)
        return fail(error, LAM_CANNOT_READ, "%s: TGA with interleaved rows (flags %u), expected rows in order",
                    file->name, flags);
    uint32_t color_bits = tga->kind == COLOR ? tga->bits : tga->kind == PALETTE ? tga->color_bits : 0;
    uint32_t alpha = color_bits == 32 ? 8 : color_bits == 16 ? 1 : 0;
    if (tga->alpha_bits != 0 && tga->alpha_bits != alpha)
        return fail(error, LAM_CANNOT_READ, "%s: TGA with %u bits of alpha, expected %u of colours of %u bits",
                    file->name, tga->alpha_bits, alpha, color_bits);
    return (tga->width > 0 && tga->height > 0) ||
           fail(error, LAM_CANNOT_READ, "%s: TGA of %u×%u pixels, expected at least 1×1", file->name, tga->width,
                tga->height);
}

static bool tga_probe(const uint8_t *bytes, size_t size)
{
    struct tga tga;
    return size >= HEADER && take_header(&(struct picture_file){bytes, size, "", NULL}, &tga, NULL);
}

static size_t bytes_of(uint32_t bits) { return (bits + 7) / 8; }

static void put_color(uint32_t bits, bool alpha, const uint8_t *from, uint8_t *to)
{
    if (bits <= 16) {
        uint32_t value = u16_at(from);
        to[0] = byte_of_5_bits(value >> 10);
        to[1] = byte_of_5_bits(value >> 5);
        to[2] = byte_of_5_bits(value);
        to[3] = !alpha || value >> 15 ? 255 : 0;
    } else {
        to[0] = from[2];
        to[1] = from[1];
        to[2] = from[0];
        to[3] = bits == 32 ? from[3] : 255;
    }
}

static bool put_pixel(const struct tga *tga, const uint8_t *from, uint8_t *to, lam_error *error)
{
    if (tga->kind == COLOR) {
        put_color(tga->bits, tga->alpha_bits == 1, from, to);
    } else if (tga->kind == GREY) {
        memset(to, *from, 3);
        to[3] = 255;
    } else {
        uint32_t index = *from - tga->first; // an index below the first entry wraps around to a large number
        if (index >= tga->colors)
            return fail(error, LAM_CANNOT_READ, "%s: TGA byte %zu: colour %u, but the palette has %u to %u",
                        tga->file->name, (size_t)(from - tga->file->bytes), *from, tga->first,
                        tga->first + tga->colors - 1);
        put_color(tga->color_bits, tga->alpha_bits == 1, tga->palette + index * bytes_of(tga->color_bits), to);
    }
    return true;
}

// Returns the address of a pixel in the picture. `x` and `y` are the pixel's column and row in the order of the file.
static uint8_t *place_of(const struct tga *tga, const lam_image *image, uint32_t x, uint32_t y)
{
    size_t row = tga->top_down ? y : tga->height - 1 - y, column = tga->right_to_left ? tga->width - 1 - x : x;
    return (uint8_t *)image->pixels + 4 * (row * tga->width + column);
}

static bool fail_end(const struct tga *tga, const char *within, lam_error *error)
{
    return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, within the TGA %s", tga->file->name, tga->file->size,
                within);
}

// Decodes packets. A packet begins with one byte, which contains a count (1 to 128) and a flag (bit 7). If the flag is
// set, one pixel follows, and the count is the number of its copies. Otherwise, the count is the number of pixels that
// follow. In version 2 of the format, packets end at the end of a row; in older files they may continue in the next
// row.
static bool put_pixels(const struct tga *tga, const uint8_t *at, const lam_image *image, lam_error *error)
{
    const uint8_t *end = tga->file->bytes + tga->file->size;
    size_t step = bytes_of(tga->bits);
    uint32_t left = 0; // remaining pixels of the packet
    bool repeated = false;
    for (uint32_t y = 0; y < tga->height; y++) {
        if (!picture_continues(tga->file, y, error))
            return false;
        for (uint32_t x = 0; x < tga->width; x++) {
            if (tga->runs && left == 0) {
                if (at == end)
                    return fail_end(tga, "run lengths", error);
                repeated = *at & 128;
                left = (*at++ & 127u) + 1;
                if ((uint64_t)(tga->height - 1 - y) * tga->width + (tga->width - x) < left)
                    return fail(error, LAM_CANNOT_READ, "%s: TGA byte %zu: a run of %u pixels after the last one",
                                tga->file->name, (size_t)(at - 1 - tga->file->bytes), left);
            }
            if ((size_t)(end - at) < step)
                return fail_end(tga, "pixels", error);
            if (!put_pixel(tga, at, place_of(tga, image, x, y), error))
                return false;
            left -= tga->runs;
            at += repeated && left > 0 ? 0 : step;
        }
    }
    return true;
}

// If the alpha of every pixel is 0, sets the alpha of every pixel to 255.
static void fill_alpha(const lam_image *image)
{
    uint8_t *pixels = image->pixels;
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++)
        if (pixels[4 * i + 3] != 0)
            return;
    for (size_t i = 0; i < count; i++)
        pixels[4 * i + 3] = 255;
}

static bool tga_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    struct tga tga = {.file = file};
    if (file->size < HEADER)
        return fail_end(&tga, "header", error);
    if (!take_header(file, &tga, error))
        return false;
    size_t palette = HEADER + (size_t)file->bytes[0], pixels = palette + tga.colors * bytes_of(tga.color_bits);
    if (pixels > file->size)
        return fail_end(&tga, palette > file->size ? "remark" : "palette", error);
    if (!picture_size_check(file, tga.width, tga.height, error))
        return false;
    // A run-length packet (one byte and one pixel) expands to at most 128 pixels.
    uint64_t count = (uint64_t)tga.width * tga.height, step = bytes_of(tga.bits);
    uint64_t least = tga.runs ? (count + 127) / 128 * (1 + step) : count * step;
    if (least > file->size - pixels)
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, but the TGA's %u×%u pixels take up to byte %llu%s",
                    file->name, file->size, tga.width, tga.height, (unsigned long long)(least + pixels),
                    tga.runs ? " at least" : "");
    if (!picture_make(file, tga.width, tga.height, LAM_RGBA8, image, error))
        return false;
    tga.palette = file->bytes + palette;
    if (!put_pixels(&tga, file->bytes + pixels, image, error)) {
        picture_free(file->call, image);
        return false;
    }
    if (tga.alpha_bits == 0 && tga.kind != GREY)
        fill_alpha(image);
    return true;
}

const struct codec codec_tga = {
    .name = "tga", .title = "TGA", .pixels = LAM_RGBA8, .unmarked = true, .probe = tga_probe, .read = tga_read};
