// bmp.c: reads Windows and OS/2 bitmaps: 1, 4, 8, 16, 24 and 32 bits, colour masks, run lengths of 4 and 8 bits,
// bottom-up and top-down rows, headers from BITMAPCOREHEADER (12 bytes) to BITMAPV5HEADER (124).
// https://learn.microsoft.com/windows/win32/gdi/bitmap-storage and, for OS/2's header of 16 to 64 bytes,
// https://www.fileformat.info/format/os2bmp/egff.htm
//
// In pixels of 32 bits without masks, the fourth byte is ignored, as the format specifies. Pixels that the run lengths
// skip have the first colour of the palette. Colour profiles are ignored.
#include "codec.h"
#include "fail.h"
#include "little_endian.h"

#include <string.h>

enum compression { BI_RGB, BI_RLE8, BI_RLE4, BI_BITFIELDS, BI_JPEG, BI_PNG, BI_ALPHABITFIELDS };
enum { FILE_HEADER = 14, CORE_HEADER = 12, INFO_HEADER = 40, OS2_SHORTEST = 16, OS2_HEADER = 64, MASKS = 4 };

// The bits of a colour channel in a pixel of 16 or 32 bits.
struct mask {
    uint32_t max; // the largest value; 0 means that there is no such channel
    int shift;
};

struct bmp {
    const struct picture_file *file;
    uint32_t width, height, bits, compression;
    size_t header; // size of the header after the 14 bytes of the file header
    size_t pixels; // offset of the pixels
    bool top_down;
    uint32_t colors; // number of colours in the palette
    uint8_t palette[256][4];
    struct mask masks[MASKS]; // red, green, blue, alpha
};

static bool bmp_probe(const uint8_t *bytes, size_t size)
{
    if (size < FILE_HEADER + 4 || bytes[0] != 'B' || bytes[1] != 'M')
        return false;
    uint32_t header = u32_at(bytes + FILE_HEADER);
    return header >= CORE_HEADER &&
           header <= 4096; // excludes texts that begin with BM: their bytes at this position form a larger number
}

static bool fail_end(const struct bmp *bmp, const char *within, lam_error *error)
{
    return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, within the BMP %s", bmp->file->name, bmp->file->size,
                within);
}

static bool read_mask(struct bmp *bmp, int index, uint32_t bits, lam_error *error)
{
    static const char *const words[MASKS] = {"red", "green", "blue", "alpha"};
    struct mask *mask = &bmp->masks[index];
    *mask = (struct mask){0};
    if (bits) {
        mask->shift = __builtin_ctz(bits);
        mask->max = bits >> mask->shift;
    }
    if ((mask->max & (mask->max + 1)) != 0 || (bmp->bits == 16 && bits > 0xffff))
        return fail(error, LAM_CANNOT_READ,
                    "%s: BMP: the mask of %s is 0x%x, expected bits side by side of a pixel's %u", bmp->file->name,
                    words[index], bits, bmp->bits);
    return true;
}

// Reads the masks. If the header has 40 bytes, the masks follow it; a longer header contains the masks.
static bool read_masks(struct bmp *bmp, lam_error *error)
{
    static const uint32_t usual[2][MASKS] = {{0x7c00, 0x3e0, 0x1f, 0}, {0xff0000, 0xff00, 0xff, 0}};
    const uint8_t *bytes = bmp->file->bytes + FILE_HEADER + INFO_HEADER;
    bool own = bmp->compression != BI_RGB;
    int count = bmp->compression == BI_ALPHABITFIELDS || (own && bmp->header >= 56) ? 4 : 3;
    if (own && bmp->file->size < (size_t)FILE_HEADER + INFO_HEADER + 4 * (size_t)count)
        return fail_end(bmp, "header", error);
    for (int i = 0; i < MASKS; i++) {
        uint32_t bits = !own ? usual[bmp->bits == 32][i] : i < count ? u32_at(bytes + 4 * i) : 0;
        if (!read_mask(bmp, i, bits, error))
            return false;
    }
    if (own && bmp->header == INFO_HEADER)
        bmp->header += 4 * (size_t)count; // the palette, if there is one, follows the masks
    return true;
}

// Reads the palette. An entry has three bytes if the header has 12 bytes, otherwise four; blue is first. The palette
// may be too short for some values of a pixel.
static bool read_palette(struct bmp *bmp, uint32_t used, lam_error *error)
{
    size_t start = FILE_HEADER + bmp->header, entry = bmp->header == CORE_HEADER ? 3 : 4;
    size_t room = bmp->pixels > start ? (bmp->pixels - start) / entry : 0;
    uint32_t most = 1u << bmp->bits;
    bmp->colors = used && used < most ? used : most;
    if (room < bmp->colors)
        bmp->colors = (uint32_t)room;
    if (bmp->colors == 0)
        return fail(error, LAM_CANNOT_READ, "%s: BMP of %u bits without a palette: the pixels begin at byte %zu",
                    bmp->file->name, bmp->bits, bmp->pixels);
    if (bmp->file->size < start + bmp->colors * entry)
        return fail_end(bmp, "palette", error);
    const uint8_t *from = bmp->file->bytes + start;
    for (uint32_t i = 0; i < bmp->colors; i++, from += entry)
        memcpy(bmp->palette[i], (const uint8_t[4]){from[2], from[1], from[0], 255}, 4);
    return true;
}

static bool bits_are_known(const struct bmp *bmp)
{
    uint32_t bits = bmp->bits;
    switch (bmp->compression) {
    case BI_RGB:
        return bits == 1 || bits == 4 || bits == 8 || bits == 16 || bits == 24 || bits == 32;
    case BI_RLE8:
        return bits == 8;
    case BI_RLE4:
        return bits == 4;
    default:
        return bits == 16 || bits == 32;
    }
}

static bool check_kind(const struct bmp *bmp, bool os2, lam_error *error)
{
    const char *name = bmp->file->name;
    if (bmp->compression == BI_JPEG || bmp->compression == BI_PNG)
        return fail(error, LAM_UNSUPPORTED, "%s: BMP that contains a %s, expected pixels or run lengths", name,
                    bmp->compression == BI_JPEG ? "JPEG" : "PNG");
    if (bmp->compression > BI_ALPHABITFIELDS || (os2 && bmp->compression > BI_RLE4))
        return fail(error, LAM_UNSUPPORTED, "%s: BMP with compression %u, expected %s", name, bmp->compression,
                    os2 ? "0 to 2" : "0 to 3 or 6");
    if (!bits_are_known(bmp))
        return fail(error, LAM_UNSUPPORTED, "%s: BMP of %u bits with compression %u, expected %s", name, bmp->bits,
                    bmp->compression,
                    bmp->compression == BI_RLE8   ? "8 bits"
                    : bmp->compression == BI_RLE4 ? "4 bits"
                    : bmp->compression            ? "16 or 32 bits"
                                                  : "1, 4, 8, 16, 24 or 32 bits");
    if (bmp->top_down && (bmp->compression == BI_RLE8 || bmp->compression == BI_RLE4))
        return fail(error, LAM_CANNOT_READ, "%s: BMP of run lengths with the top row first, expected the bottom row",
                    name);
    return true;
}

static bool read_header(struct bmp *bmp, lam_error *error)
{
    const struct picture_file *file = bmp->file;
    const uint8_t *at = file->bytes + FILE_HEADER;
    if (file->size < FILE_HEADER + 4)
        return fail_end(bmp, "header", error);
    bmp->header = u32_at(at);
    bmp->pixels = u32_at(file->bytes + 10);
    bool core = bmp->header == CORE_HEADER;
    bool os2 = bmp->header >= OS2_SHORTEST && bmp->header <= OS2_HEADER && bmp->header % 4 == 0 &&
               bmp->header != INFO_HEADER && bmp->header != 52 && bmp->header != 56;
    if (!core && !os2 && bmp->header != INFO_HEADER && bmp->header != 52 && bmp->header != 56 && bmp->header != 108 &&
        bmp->header != 124)
        return fail(error, LAM_UNSUPPORTED, "%s: BMP with a header of %zu bytes, expected 12, 16 to 64, 108 or 124",
                    file->name, bmp->header);
    if (file->size < FILE_HEADER + bmp->header)
        return fail_end(bmp, "header", error);
    uint32_t used = 0;
    if (core) {
        bmp->width = u16_at(at + 4);
        bmp->height = u16_at(at + 6);
        bmp->bits = u16_at(at + 10);
    } else {
        bmp->width = u32_at(at + 4);
        bmp->height = u32_at(at + 8);
        bmp->bits = u16_at(at + 14);
        bmp->compression = bmp->header >= 20 ? u32_at(at + 16) : BI_RGB;
        used = bmp->header >= 36 ? u32_at(at + 32) : 0;
        bmp->top_down = bmp->height > INT32_MAX;
        bmp->height = bmp->top_down ? 0u - bmp->height : bmp->height;
    }
    if (!check_kind(bmp, os2, error) || !picture_size_check(file, bmp->width, bmp->height, error))
        return false;
    if ((bmp->bits == 16 || bmp->bits == 32) && !read_masks(bmp, error))
        return false;
    if (bmp->pixels < FILE_HEADER + bmp->header || bmp->pixels > file->size)
        return fail(error, LAM_CANNOT_READ, "%s: BMP: the pixels begin at byte %zu, expected %zu to %zu", file->name,
                    bmp->pixels, FILE_HEADER + bmp->header, file->size);
    return bmp->bits > 8 || read_palette(bmp, used, error);
}

static bool fail_index(const struct bmp *bmp, uint32_t index, uint32_t row, lam_error *error)
{
    return fail(error, LAM_CANNOT_READ, "%s: BMP row %u: colour %u of a palette of %u", bmp->file->name, row + 1, index,
                bmp->colors);
}

static uint8_t *row_of(const struct bmp *bmp, const lam_image *image, uint32_t y)
{
    uint32_t row = bmp->top_down ? y : bmp->height - 1 - y;
    return (uint8_t *)image->pixels + (size_t)row * bmp->width * 4;
}

static bool put_indexed(const struct bmp *bmp, const uint8_t *from, uint32_t y, uint8_t *to, lam_error *error)
{
    for (uint32_t x = 0; x < bmp->width; x++, to += 4) {
        uint32_t bit = x * bmp->bits;
        uint32_t index = from[bit / 8] >> (8 - bmp->bits - bit % 8) & ((1u << bmp->bits) - 1);
        if (index >= bmp->colors)
            return fail_index(bmp, index, y, error);
        memcpy(to, bmp->palette[index], 4);
    }
    return true;
}

// Converts a value v in 0…max to a byte: floor(255·v/max + ½).
static uint8_t masked(const struct mask *mask, uint32_t pixel)
{
    uint64_t value = pixel >> mask->shift & mask->max;
    return (uint8_t)((value * 510 + mask->max) / (2 * (uint64_t)mask->max));
}

static void put_masked(const struct bmp *bmp, const uint8_t *from, uint8_t *to)
{
    for (uint32_t x = 0; x < bmp->width; x++, to += 4, from += bmp->bits / 8) {
        uint32_t pixel = bmp->bits == 16 ? u16_at(from) : u32_at(from);
        for (int i = 0; i < MASKS; i++)
            to[i] = bmp->masks[i].max ? masked(&bmp->masks[i], pixel) : i == 3 ? 255 : 0;
    }
}

static bool put_rows(const struct bmp *bmp, const lam_image *image, lam_error *error)
{
    const uint8_t *from = bmp->file->bytes + bmp->pixels;
    size_t stride = ((size_t)bmp->width * bmp->bits + 31) / 32 * 4;
    for (uint32_t y = 0; y < bmp->height; y++, from += stride) {
        uint8_t *to = row_of(bmp, image, y);
        if (!picture_continues(bmp->file, y, error) || (bmp->bits <= 8 && !put_indexed(bmp, from, y, to, error)))
            return false;
        if (bmp->bits == 24)
            for (uint32_t x = 0; x < bmp->width; x++)
                memcpy(to + 4 * x, (const uint8_t[4]){from[3 * x + 2], from[3 * x + 1], from[3 * x], 255}, 4);
        else if (bmp->bits > 8)
            put_masked(bmp, from, to);
    }
    return true;
}

// Decodes run lengths, two bytes at a time. Usually the bytes are a count and a colour (with 4 bits, two alternating
// colours). If the count is 0, the second byte is a code: 0 ends the row, 1 ends the picture, and 2 moves right by x
// and up by y (the next two bytes). After any other code n, n colours follow, padded to two bytes.
static bool put_runs(const struct bmp *bmp, const lam_image *image, lam_error *error)
{
    const uint8_t *at = bmp->file->bytes + bmp->pixels, *end = bmp->file->bytes + bmp->file->size;
    const bool half = bmp->bits == 4;
    uint32_t x = 0, y = 0;
    for (size_t step = 0; end - at >= 2; step++) {
        uint32_t count = at[0], second = at[1];
        bool literal = count == 0 && second > 2;
        at += 2;
        if (step % 4096 == 0 && !picture_continues(bmp->file, 0, error))
            return false;
        if (count == 0 && second == 1)
            return true;
        if (count == 0 && second == 0) {
            x = 0;
            y++;
            continue;
        }
        if (count == 0 && second == 2) {
            if (end - at < 2)
                break;
            x += at[0];
            y += at[1];
            at += 2;
            continue;
        }
        count = literal ? second : count;
        size_t bytes = literal ? ((half ? (count + 1) / 2 : count) + 1) / 2 * 2 : 0;
        if (y >= bmp->height || x > bmp->width || count > bmp->width - x)
            return fail(error, LAM_CANNOT_READ,
                        "%s: BMP byte %zu: a run of %u pixels at %u, %u leaves the %u×%u pixels", bmp->file->name,
                        (size_t)(at - 2 - bmp->file->bytes), count, x, y, bmp->width, bmp->height);
        if ((size_t)(end - at) < bytes)
            break;
        uint8_t *to = row_of(bmp, image, y) + 4 * (size_t)x;
        for (uint32_t i = 0; i < count; i++, to += 4) {
            uint32_t index = !literal ? second : half ? at[i / 2] : at[i];
            index = half ? index >> (i % 2 ? 0 : 4) & 15 : index;
            if (index >= bmp->colors)
                return fail_index(bmp, index, y, error);
            memcpy(to, bmp->palette[index], 4);
        }
        x += count;
        at += bytes;
    }
    return fail_end(bmp, "run lengths", error);
}

static bool bmp_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    struct bmp bmp = {.file = file};
    if (!read_header(&bmp, error))
        return false;
    bool runs = bmp.compression == BI_RLE8 || bmp.compression == BI_RLE4;
    uint64_t bytes = ((uint64_t)bmp.width * bmp.bits + 31) / 32 * 4 * bmp.height;
    if (!runs && bytes > file->size - bmp.pixels)
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, but the BMP's %u×%u pixels take up to byte %llu",
                    file->name, file->size, bmp.width, bmp.height, (unsigned long long)(bytes + bmp.pixels));
    if (!picture_make(file, bmp.width, bmp.height, LAM_RGBA8, image, error))
        return false;
    for (size_t i = 0; runs && i < (size_t)bmp.width * bmp.height; i++)
        memcpy((uint8_t *)image->pixels + 4 * i, bmp.palette[0], 4);
    if (runs ? put_runs(&bmp, image, error) : put_rows(&bmp, image, error))
        return true;
    picture_free(file->call, image);
    return false;
}

const struct codec codec_bmp = {
    .name = "bmp", .title = "BMP", .pixels = LAM_RGBA8, .probe = bmp_probe, .read = bmp_read};
