// mutate_jpeg.c: changes a segment of a JPEG file, or the coded pixels after a start of scan, and updates the segments'
// lengths. Zero bytes follow 255 in coded pixels, as the format requires. One file in eight is changed without repair.
#include "mutate.h"

enum { SOI = 0xd8, EOI = 0xd9, SOS = 0xda, CODED = 0 }; // CODED: coded pixels, not a marker

// Markers without a length.
static bool stands_alone(int marker) { return marker == 1 || (marker >= 0xd0 && marker <= EOI); }

static bool is_frame(int marker)
{
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

static bool split(struct parts *parts, const uint8_t *data, size_t size)
{
    if (size < 4 || data[0] != 0xff || data[1] != SOI)
        return false;
    for (size_t at = 0; at + 2 <= size;) {
        if (data[at] != 0xff || data[at + 1] == 0 || (data[at + 1] >= 0xd0 && data[at + 1] <= 0xd7)) {
            size_t end = at + 1; // to the next marker that is not a restart marker
            while (end < size && !(data[end - 1] == 0xff && data[end] != 0 && (data[end] < 0xd0 || data[end] > 0xd7)))
                end++;
            end -= end < size;
            end = end > at ? end : at + 1;
            if (!add_part(parts, (uint8_t[]){CODED}, 1, data + at, end - at))
                break;
            at = end;
            continue;
        }
        int marker = data[at + 1];
        size_t length = 0;
        if (!stands_alone(marker) && at + 4 <= size)
            length = (size_t)(data[at + 2] << 8 | data[at + 3]);
        size_t body = length > 2 ? length - 2 : 0, start = at + 2 + (length ? 2 : 0);
        start = start < size ? start : size;
        body = body < size - start ? body : size - start;
        if (!add_part(parts, &data[at + 1], 1, data + start, body))
            break;
        at = start + body;
    }
    return parts->count > 0;
}

// Size, components and their shares of the pixels.
static void change_frame(struct parts *parts, struct part *frame)
{
    static const uint8_t sampling[] = {0x11, 0x21, 0x12, 0x22, 0x41, 0x14, 0x31, 0x44, 0x00};
    if (frame->size < 6)
        return;
    switch (random_below(parts, 6)) {
    case 0:
        frame->name[0] = (uint8_t)(0xc0 + random_below(parts, 3));
        break;
    case 1: {
        size_t count = (frame->size - 6) / 3, which = random_below(parts, (uint32_t)count);
        if (count)
            frame->bytes[6 + 3 * which + 1] = sampling[random_below(parts, sizeof sampling)];
        break;
    }
    case 2: {
        uint8_t count = (uint8_t)(1 + random_below(parts, 4));
        for (size_t i = (frame->size - 6) / 3; i < count; i++)
            memcpy(frame->bytes + 6 + 3 * i, (uint8_t[]){(uint8_t)(i + 1), 0x11, 0}, 3);
        frame->bytes[5] = count;
        frame->size = 6 + 3 * (size_t)count;
        break;
    }
    default: {
        size_t at = random_below(parts, 2) ? 1 : 3;
        frame->bytes[at] = 0;
        frame->bytes[at + 1] = (uint8_t)(1 + random_below(parts, 80));
    }
    }
}

static size_t join(struct parts *parts, uint8_t *data, size_t capacity)
{
    struct joined out = {.bytes = data, .capacity = capacity};
    for (int i = 0; i < parts->count; i++) {
        const struct part *part = &parts->list[i];
        int marker = part->name[0];
        if (marker == CODED) {
            for (size_t k = 0; k < part->size; k++) {
                uint8_t byte = part->bytes[k], next = k + 1 < part->size ? part->bytes[k + 1] : 0;
                put_bytes(&out, &byte, 1);
                if (byte == 0xff && next != 0 && (next < 0xd0 || next > 0xd7))
                    put_bytes(&out, "", 1);
            }
            continue;
        }
        put_bytes(&out, (uint8_t[]){0xff, (uint8_t)marker}, 2);
        if (stands_alone(marker))
            continue;
        size_t size = part->size < 65533 ? part->size : 65533;
        put_bytes(&out, (uint8_t[]){(uint8_t)((size + 2) >> 8), (uint8_t)(size + 2)}, 2);
        put_bytes(&out, part->bytes, size);
    }
    return out.size;
}

static void change(struct parts *parts)
{
    struct part *part = &parts->list[random_below(parts, (uint32_t)parts->count)];
    uint32_t kind = random_below(parts, 16);
    if (kind < 2)
        rearrange(parts);
    else if (kind < 3) // restarts
        add_part(parts, (uint8_t[]){0xdd}, 1, (uint8_t[]){0, (uint8_t)random_below(parts, 4)}, 2);
    else if (is_frame(part->name[0]) && kind < 14)
        change_frame(parts, part);
    else
        mutate_part(part);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t capacity, unsigned seed)
{
    return mutate_parts(data, size, capacity, seed, split, change, join);
}
