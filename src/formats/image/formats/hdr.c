// hdr.c: reads Radiance pictures (.hdr, RGBE), which store linear light as three mantissas and one exponent per pixel.
//
// The file consists of text lines, an empty line, a line with the size ("-Y 512 +X 1024"), and rows of pixels. Each row
// is encoded by one of three methods:
//  new runs   2, 2, width as two bytes (8 … 32767), then the row's red, green, blue and exponent bytes one after the
//             other: a count above 128 is a run of count − 128 equal bytes; otherwise that many single bytes follow
//  old runs   pixels; 1, 1, 1, n repeats the previous pixel n times; directly after another run n · 256 times, and so on
//  plain      pixels
// A pixel is mantissa · 2^(exponent − 136), and black if the exponent is 0. EXPOSURE lines are ignored, like PFM's
// scale, because programs interpret them differently.
#include "codec.h"
#include "fail.h"

#include <stdlib.h>
#include <string.h>

static bool hdr_probe(const uint8_t *bytes, size_t size)
{
    return (size >= 11 && memcmp(bytes, "#?RADIANCE\n", 11) == 0) || (size >= 7 && memcmp(bytes, "#?RGBE\n", 7) == 0);
}

struct header {
    int width, height;
    bool up, left; // rows are stored upwards, pixels from right to left
    size_t pixels; // the offset of the pixels
};

// Returns the end of the line that starts at `at`, or NULL if the file ends within the line.
static const uint8_t *line_end(const uint8_t *at, const uint8_t *end)
{
    const uint8_t *found = memchr(at, '\n', (size_t)(end - at));
    return found;
}

// Parses a number such as " 512" and moves *at to the end of the number. Returns −1 if the number is not 1 … 65535.
static int side_at(const uint8_t **at, const uint8_t *end)
{
    int value = 0;
    while (*at < end && **at == ' ')
        ++*at;
    while (*at < end && **at >= '0' && **at <= '9' && value <= 65535)
        value = value * 10 + *(*at)++ - '0';
    return value >= 1 && value <= 65535 ? value : -1;
}

static bool read_size(const uint8_t *at, const uint8_t *end, const char *name, struct header *header, lam_error *error)
{
    const uint8_t *start = at;
    if (end - at >= 2 && (at[0] == '-' || at[0] == '+') && at[1] == 'Y') {
        header->up = at[0] == '+';
        at += 2;
        header->height = side_at(&at, end);
        while (at < end && *at == ' ')
            at++;
        if (header->height > 0 && end - at >= 2 && (at[0] == '-' || at[0] == '+') && at[1] == 'X') {
            header->left = at[0] == '-';
            at += 2;
            header->width = side_at(&at, end);
            if (header->width > 0 && (at == end || *at == '\r'))
                return true;
        }
    }
    if (end - start >= 2 && (start[0] == '-' || start[0] == '+') && start[1] == 'X')
        return fail(error, LAM_UNSUPPORTED,
                    "%s: the Radiance picture's size is '%.*s': columns first, expected -Y and +X", name,
                    (int)(end - start < 40 ? end - start : 40), (const char *)start);
    return fail(error, LAM_CANNOT_READ,
                "%s: the Radiance header has a size of '%.*s', expected '-Y height +X width', 1 to 65535", name,
                (int)(end - start < 40 ? end - start : 40), (const char *)start);
}

static bool read_header(const uint8_t *bytes, size_t size, const char *name, struct header *header, lam_error *error)
{
    static const char format[] = "FORMAT=", rgbe[] = "32-bit_rle_rgbe";
    const uint8_t *at = bytes, *end = bytes + size, *stop;
    for (bool text = true; text; at = stop + 1) {
        stop = line_end(at, end);
        if (!stop)
            return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, within the Radiance header", name, size);
        size_t length = (size_t)(stop - at) - (stop > at && stop[-1] == '\r');
        if (length >= sizeof format - 1 && memcmp(at, format, sizeof format - 1) == 0 &&
            (length < sizeof format + sizeof rgbe - 2 || memcmp(at + sizeof format - 1, rgbe, sizeof rgbe - 1) != 0))
            return fail(error, LAM_UNSUPPORTED, "%s: Radiance %.*s, expected FORMAT=%s", name,
                        (int)(length < 60 ? length : 60), (const char *)at, rgbe);
        text = length > 0;
    }
    stop = line_end(at, end);
    if (!stop)
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, within the Radiance header", name, size);
    header->pixels = (size_t)(stop + 1 - bytes);
    return read_size(at, stop, name, header, error);
}

// The next functions read a row, and return the end of the row in the file. If the row is invalid, or if the file ends
// within the row, these functions return NULL. `row` receives 4 bytes per pixel.

static const uint8_t *read_new_runs(const uint8_t *at, const uint8_t *end, int width, uint8_t *row)
{
    for (int channel = 0; channel < 4; channel++) {
        for (int x = 0; x < width;) {
            if (end - at < 2)
                return NULL;
            int count = *at++;
            bool run = count > 128;
            count -= run ? 128 : 0;
            if (count == 0 || count > width - x || (!run && end - at < count))
                return NULL;
            for (int i = 0; i < count; i++, x++)
                row[4 * x + channel] = run ? *at : *at++;
            at += run;
        }
    }
    return at;
}

static const uint8_t *read_old_runs(const uint8_t *at, const uint8_t *end, int width, uint8_t *row)
{
    int shift = 0;
    for (int x = 0; x < width;) {
        if (end - at < 4)
            return NULL;
        if (x > 0 && at[0] == 1 && at[1] == 1 && at[2] == 1) {
            if (shift > 16 || (at[3] << shift) > width - x)
                return NULL;
            for (int count = at[3] << shift; count > 0; count--, x++)
                memcpy(row + 4 * x, row + 4 * (x - 1), 4);
            shift += 8;
        } else {
            memcpy(row + 4 * x++, at, 4);
            shift = 0;
        }
        at += 4;
    }
    return at;
}

static const uint8_t *read_row(const uint8_t *at, const uint8_t *end, int width, uint8_t *row)
{
    if (width >= 8 && width <= 32767 && end - at >= 4 && at[0] == 2 && at[1] == 2 && (at[2] << 8 | at[3]) == width)
        return read_new_runs(at + 4, end, width, row);
    return read_old_runs(at, end, width, row);
}

static void store_row(const struct header *header, const uint8_t *row, const float scale[256], float *out)
{
    for (int x = 0; x < header->width; x++) {
        const uint8_t *pixel = row + 4 * (header->left ? header->width - 1 - x : x);
        for (int channel = 0; channel < 3; channel++)
            out[4 * x + channel] = (float)pixel[channel] * scale[pixel[3]];
        out[4 * x + 3] = 1.0f;
    }
}

// Fills the table of 2^(exponent − 136). The entry is 0 if the exponent is 0 or the power is below the smallest normal
// float.
static void fill_scale(float scale[256])
{
    double value = 0x1p119;
    for (int exponent = 255; exponent >= 0; exponent--, value *= 0.5)
        scale[exponent] = exponent > 10 ? (float)value : 0.0f;
}

// A file is suspiciously small if each byte represents more pixels than this; uncompressed pixels need four bytes.
enum { PIXELS_OF_A_BYTE = 2 };

static bool read_rows(const struct picture_file *file, const struct header *header, uint8_t *row, lam_image *image,
                      lam_error *error)
{
    const uint8_t *end = file->bytes + file->size;
    float scale[256];
    fill_scale(scale);
    // If a small file declares a huge picture, its rows are read twice. The first pass checks the rows before memory is
    // allocated.
    size_t pixels = (size_t)header->width * (size_t)header->height;
    for (int pass = pixels / PIXELS_OF_A_BYTE < file->size; pass < 2; pass++) {
        const uint8_t *at = file->bytes + header->pixels;
        if (pass == 1 &&
            !picture_make(file, (uint32_t)header->width, (uint32_t)header->height, LAM_RGBA32F, image, error))
            return false;
        for (int y = 0; y < header->height; y++) {
            if (!picture_continues(file, y, error))
                return false;
            const uint8_t *next = read_row(at, end, header->width, row);
            if (!next)
                return fail(error, LAM_CANNOT_READ,
                            "%s: byte %zu: row %d of %d is broken off or has a wrong run, expected %d pixels",
                            file->name, (size_t)(at - file->bytes), y + 1, header->height, header->width);
            at = next;
            size_t to = (size_t)(header->up ? header->height - 1 - y : y) * (size_t)header->width * 4;
            if (pass == 1)
                store_row(header, row, scale, (float *)image->pixels + to);
        }
    }
    image->no_alpha = true;
    return true;
}

static bool hdr_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    struct header header;
    if (!read_header(file->bytes, file->size, file->name, &header, error) ||
        !picture_size_check(file, (uint32_t)header.width, (uint32_t)header.height, error))
        return false;
    uint8_t *row = malloc((size_t)header.width * 4);
    if (!row)
        return fail_memory(error, (size_t)header.width * 4);
    bool ok = read_rows(file, &header, row, image, error);
    free(row);
    if (!ok)
        picture_free(file->call, image);
    return ok;
}

const struct codec codec_hdr = {
    .name = "hdr", .title = "Radiance", .pixels = LAM_RGBA32F, .probe = hdr_probe, .read = hdr_read};
