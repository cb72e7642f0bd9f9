// mutate_chunks.h: a mutator for files of chunks with a length of 32 bits, little-endian: binary glTF and WebP. The
// includer defines HEAD, the bytes before the first chunk; NAME_FIRST, whether a chunk's name precedes its length;
// ROUND, the alignment of chunks; PADDING, the byte; head_put, which writes the head of a file of `size` bytes.
#include "mutate.h"

static bool split(struct parts *parts, const uint8_t *data, size_t size)
{
    if (size < HEAD || !head_probe(data))
        return false;
    for (size_t at = HEAD; size - at >= 8;) {
        size_t length = u32_little(data + at + (NAME_FIRST ? 4 : 0)), left = size - at - 8;
        length = length < left ? length : left;
        if (!add_part(parts, data + at + (NAME_FIRST ? 0 : 4), 4, data + at + 8, length))
            break;
        at += 8 + length;
        size_t gap = (ROUND - length % ROUND) % ROUND;
        at += gap < size - at ? gap : size - at;
    }
    return parts->count > 0;
}

static size_t join(struct parts *parts, uint8_t *data, size_t capacity)
{
    struct joined out = {.bytes = data, .capacity = capacity};
    static const uint8_t nothing[HEAD];
    put_bytes(&out, nothing, HEAD);
    for (int i = 0; i < parts->count; i++) {
        const struct part *part = &parts->list[i];
        size_t gap = (ROUND - part->size % ROUND) % ROUND, length = part->size + (NAME_FIRST ? 0 : gap);
        if (NAME_FIRST)
            put_bytes(&out, part->name, 4);
        put_u32_little(&out, (uint32_t)length);
        if (!NAME_FIRST)
            put_bytes(&out, part->name, 4);
        put_bytes(&out, part->bytes, part->size);
        const uint8_t padding[4] = {PADDING, PADDING, PADDING, PADDING};
        put_bytes(&out, padding, gap);
    }
    if (capacity >= HEAD)
        head_put(data, out.size);
    return out.size;
}

static void change(struct parts *parts)
{
    if (random_below(parts, 8) == 0)
        rearrange(parts);
    else
        mutate_part(&parts->list[random_below(parts, (uint32_t)parts->count)]);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t capacity, unsigned seed)
{
    return mutate_parts(data, size, capacity, seed, split, change, join);
}
