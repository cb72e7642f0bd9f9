// mutate.h: functions shared by the mutators of formats whose files contain checksums or lengths. A mutator splits a
// file into parts, changes one part, and reassembles the file so that it passes the reader's checks. libFuzzer calls it
// (LLVMFuzzerCustomMutator), and so does replay.c.
#ifndef MUTATE_H
#define MUTATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// Changes `size` bytes in place, to at most `capacity`; returns the new size. Defined by libFuzzer or by replay.c.
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t capacity);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t capacity, unsigned seed);

enum { PARTS_MAX = 64, PART_BYTES = 1 << 16 };

// One part of a file. `name` identifies its kind: a chunk's type, a marker.
struct part {
    uint8_t name[4];
    uint8_t *bytes; // allocated with malloc, PART_BYTES of them
    size_t size;
};

struct parts {
    struct part list[PARTS_MAX];
    int count;
    uint64_t random;
};

static inline uint32_t random_below(struct parts *parts, uint32_t limit)
{
    parts->random = parts->random * 6364136223846793005u + 1442695040888963407u;
    return limit ? (uint32_t)(parts->random >> 33) % limit : 0;
}

// Returns false if there is no room for it.
static inline bool add_part(struct parts *parts, const uint8_t *name, size_t name_size, const uint8_t *bytes,
                            size_t size)
{
    if (parts->count == PARTS_MAX || size > PART_BYTES)
        return false;
    struct part *part = &parts->list[parts->count];
    *part = (struct part){.bytes = malloc(PART_BYTES), .size = size};
    if (!part->bytes)
        return false;
    memcpy(part->name, name, name_size);
    if (size)
        memcpy(part->bytes, bytes, size);
    parts->count++;
    return true;
}

static inline void free_parts(struct parts *parts)
{
    for (int i = 0; i < parts->count; i++)
        free(parts->list[i].bytes);
    parts->count = 0;
}

// Changes the bytes of a part. No part grows by more than 256 bytes, so that files stay small.
static inline void mutate_part(struct part *part)
{
    size_t capacity = part->size + 256 < PART_BYTES ? part->size + 256 : PART_BYTES;
    part->size = LLVMFuzzerMutate(part->bytes, part->size, capacity);
}

// Omits, doubles or swaps parts.
static inline void rearrange(struct parts *parts)
{
    if (parts->count < 2)
        return;
    int i = (int)random_below(parts, (uint32_t)parts->count), j = (int)random_below(parts, (uint32_t)parts->count);
    struct part part = parts->list[i];
    switch (random_below(parts, 3)) {
    case 0:
        free(part.bytes);
        memmove(&parts->list[i], &parts->list[i + 1], (size_t)(parts->count - i - 1) * sizeof part);
        parts->count--;
        break;
    case 1:
        add_part(parts, part.name, sizeof part.name, part.bytes, part.size);
        break;
    default:
        parts->list[i] = parts->list[j];
        parts->list[j] = part;
    }
}

// A file under construction; parts that do not fit are omitted.
struct joined {
    uint8_t *bytes;
    size_t size, capacity;
};

static inline void put_bytes(struct joined *out, const void *bytes, size_t size)
{
    if (size > out->capacity - out->size)
        size = out->capacity - out->size;
    if (size)
        memcpy(out->bytes + out->size, bytes, size);
    out->size += size;
}

static inline void put_u32_big(struct joined *out, uint32_t x)
{
    put_bytes(out, (uint8_t[]){(uint8_t)(x >> 24), (uint8_t)(x >> 16), (uint8_t)(x >> 8), (uint8_t)x}, 4);
}

static inline void put_u32_little(struct joined *out, uint32_t x)
{
    put_bytes(out, (uint8_t[]){(uint8_t)x, (uint8_t)(x >> 8), (uint8_t)(x >> 16), (uint8_t)(x >> 24)}, 4);
}

// Splits a file into parts, changes them and reassembles the file, in place; returns the new size. Sometimes, and if the
// file cannot be split, changes its bytes instead.
static inline size_t mutate_parts(uint8_t *data, size_t size, size_t capacity, unsigned seed,
                                  bool (*split)(struct parts *parts, const uint8_t *data, size_t size),
                                  void (*change)(struct parts *parts),
                                  size_t (*join)(struct parts *parts, uint8_t *data, size_t capacity))
{
    struct parts parts = {.random = seed};
    if (random_below(&parts, 8) == 0 || !split(&parts, data, size)) {
        free_parts(&parts);
        return LLVMFuzzerMutate(data, size, capacity);
    }
    change(&parts);
    size = join(&parts, data, capacity);
    free_parts(&parts);
    return size;
}

static inline uint32_t u32_big(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static inline uint32_t u32_little(const uint8_t *at)
{
    return (uint32_t)at[3] << 24 | (uint32_t)at[2] << 16 | (uint32_t)at[1] << 8 | at[0];
}

#endif
