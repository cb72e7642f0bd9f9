// mutate_png.c: changes a chunk of a PNG file, or the pixels in its compressed stream, and updates lengths, CRCs and
// the stream. One file in eight is changed without repair.
#include "mutate.h"

#include <zlib.h>

enum { SIGNATURE = 8, STREAM_MAX = 1 << 16 };

static bool split(struct parts *parts, const uint8_t *data, size_t size)
{
    if (size < SIGNATURE || memcmp(data, "\x89PNG\r\n\x1a\n", SIGNATURE) != 0)
        return false;
    for (size_t at = SIGNATURE; size - at >= 8;) {
        size_t length = u32_big(data + at), left = size - at - 8;
        length = length < left ? length : left; // a truncated chunk
        struct part *last = parts->count ? &parts->list[parts->count - 1] : NULL;
        if (last && memcmp(last->name, "IDAT", 4) == 0 && memcmp(data + at + 4, "IDAT", 4) == 0 &&
            last->size + length <= PART_BYTES) {
            memcpy(last->bytes + last->size, data + at + 8, length);
            last->size += length;
        } else if (!add_part(parts, data + at + 4, 4, data + at + 8, length))
            break;
        at += 8 + length;
        at += size - at < 4 ? size - at : 4;
    }
    return parts->count > 0;
}

static void change_header(struct parts *parts, struct part *header)
{
    static const uint8_t depths[] = {1, 2, 4, 8, 16}, types[] = {0, 2, 3, 4, 6};
    if (header->size != 13)
        return;
    switch (random_below(parts, 5)) {
    case 0:
        header->bytes[8] = depths[random_below(parts, 5)];
        break;
    case 1:
        header->bytes[9] = types[random_below(parts, 5)];
        break;
    case 2:
        header->bytes[12] ^= 1;
        break;
    default: // width or height
        header->bytes[random_below(parts, 2) ? 3 : 7] = (uint8_t)(1 + random_below(parts, 40));
    }
}

// Changes the bytes in the stream: filters and pixels.
static void change_pixels(struct parts *parts, struct part *pixels)
{
    struct part raw = {.bytes = malloc(PART_BYTES)};
    uLongf size = PART_BYTES, compressed = PART_BYTES;
    if (raw.bytes) {
        int code = uncompress(raw.bytes, &size, pixels->bytes, pixels->size);
        raw.size = code == Z_OK ? size : random_below(parts, 300); // a new stream with any contents replaces a broken
                                                                   // one
        if (code != Z_OK)
            memset(raw.bytes, 0, raw.size);
        mutate_part(&raw);
        if (compress2(pixels->bytes, &compressed, raw.bytes, raw.size, (int)random_below(parts, 10)) == Z_OK)
            pixels->size = compressed;
    }
    free(raw.bytes);
}

static void insert(struct parts *parts)
{
    static const char types[][5] = {"PLTE", "tRNS", "gAMA", "cHRM", "sBIT", "bKGD", "hIST", "pHYs", "sPLT", "tIME",
                                    "tEXt", "zTXt", "iTXt", "iCCP", "sRGB", "eXIf", "oFFs", "IDAT", "IEND", "abcd"};
    static const uint8_t sizes[] = {0, 1, 2, 3, 4, 6, 7, 9, 12, 32};
    uint8_t bytes[32];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)random_below(parts, 256);
    const char *type = types[random_below(parts, sizeof types / sizeof *types)];
    if (!add_part(parts, (const uint8_t *)type, 4, bytes, sizes[random_below(parts, sizeof sizes)]))
        return;
    int at = (int)random_below(parts, (uint32_t)parts->count);
    struct part part = parts->list[parts->count - 1];
    memmove(&parts->list[at + 1], &parts->list[at], (size_t)(parts->count - 1 - at) * sizeof part);
    parts->list[at] = part;
}

static size_t join(struct parts *parts, uint8_t *data, size_t capacity)
{
    struct joined out = {.bytes = data, .capacity = capacity};
    put_bytes(&out, "\x89PNG\r\n\x1a\n", SIGNATURE);
    for (int i = 0; i < parts->count; i++) {
        const struct part *part = &parts->list[i];
        // Writes the pixels in one chunk or in two.
        size_t first = memcmp(part->name, "IDAT", 4) == 0 && random_below(parts, 8) == 0
                           ? random_below(parts, (uint32_t)part->size)
                           : part->size;
        for (size_t at = 0, end = first; at == 0 || at < part->size; at = end, end = part->size) {
            put_u32_big(&out, (uint32_t)(end - at));
            put_bytes(&out, part->name, 4);
            put_bytes(&out, part->bytes + at, end - at);
            uLong crc = crc32(crc32(0, part->name, 4), part->bytes + at, (uInt)(end - at));
            put_u32_big(&out, (uint32_t)crc);
            if (end == part->size)
                break;
        }
    }
    return out.size;
}

static void change(struct parts *parts)
{
    struct part *part = &parts->list[random_below(parts, (uint32_t)parts->count)];
    uint32_t kind = random_below(parts, 16);
    if (kind < 2)
        rearrange(parts);
    else if (kind < 4)
        insert(parts);
    else if (kind < 7)
        change_header(parts, &parts->list[0]);
    else if (memcmp(part->name, "IDAT", 4) == 0 && kind < 15)
        change_pixels(parts, part);
    else
        mutate_part(part);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t capacity, unsigned seed)
{
    return mutate_parts(data, size, capacity, seed, split, change, join);
}
