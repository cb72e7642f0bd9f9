// draco_header.c: reads the declared sizes of a mesh compressed with Draco. https://google.github.io/draco/spec/
// (version 2.2), sections "Draco Header", "Metadata", "Sequential Connectivity Decode" and "EdgeBreaker Decode"; older
// versions are read as in Draco's decoder.
#include "draco_header.h"

#include <string.h>

enum { TRIANGULAR_MESH = 1, SEQUENTIAL = 0, EDGEBREAKER = 1, HAS_METADATA = 0x8000, METADATA_DEPTH = 16 };

struct draco_cursor {
    const uint8_t *at, *end;
    bool ok; // false if the bytes ended too early
};

static const uint8_t *skip(struct draco_cursor *r, uint64_t bytes)
{
    const uint8_t *from = r->at;
    r->ok = r->ok && bytes <= (uint64_t)(r->end - r->at);
    if (!r->ok)
        return NULL;
    r->at += bytes;
    return from;
}

static uint32_t read_u8(struct draco_cursor *r)
{
    const uint8_t *at = skip(r, 1);
    return at ? *at : 0;
}

static uint32_t read_u32(struct draco_cursor *r)
{
    const uint8_t *at = skip(r, 4);
    return at ? at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24 : 0;
}

// Reads a number that is stored with seven bits per byte, the lowest bits first.
static uint32_t read_varint(struct draco_cursor *r)
{
    uint64_t number = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        uint32_t byte = read_u8(r);
        number |= (uint64_t)(byte & 127) << shift;
        if (!(byte & 128)) {
            r->ok = r->ok && number <= UINT32_MAX;
            return (uint32_t)number;
        }
    }
    r->ok = false;
    return 0;
}

static void skip_metadata(struct draco_cursor *r, int depth)
{
    r->ok = r->ok && depth < METADATA_DEPTH;
    for (uint32_t entries = read_varint(r); r->ok && entries > 0; entries--) {
        skip(r, read_u8(r)); // the name
        skip(r, read_varint(r));
    }
    for (uint32_t inside = read_varint(r); r->ok && inside > 0; inside--) {
        skip(r, read_u8(r));
        skip_metadata(r, depth + 1);
    }
}

static void skip_all_metadata(struct draco_cursor *r)
{
    for (uint32_t attributes = read_varint(r); r->ok && attributes > 0; attributes--) {
        read_varint(r); // skips the attribute's id
        skip_metadata(r, 0);
    }
    skip_metadata(r, 0);
}

bool draco_header_read(const uint8_t *bytes, size_t size, struct draco_claim *out)
{
    struct draco_cursor r = {.at = bytes, .end = bytes + size, .ok = true};
    *out = (struct draco_claim){0};
    const uint8_t *magic = skip(&r, 5);
    if (!magic || memcmp(magic, "DRACO", 5) != 0)
        return false;
    uint32_t major = read_u8(&r), version = major << 8 | read_u8(&r), type = read_u8(&r), method = read_u8(&r);
    uint32_t flags = read_u8(&r);
    flags |= read_u8(&r) << 8;
    if (!r.ok || type != TRIANGULAR_MESH || method > EDGEBREAKER)
        return false;
    if (version >= 0x103 && flags & HAS_METADATA)
        skip_all_metadata(&r);
    if (method == SEQUENTIAL) {
        out->faces = version < 0x202 ? read_u32(&r) : read_varint(&r);
        out->points = version < 0x202 ? read_u32(&r) : read_varint(&r);
        return r.ok;
    }
    read_u8(&r);         // skips the edge coding method
    if (version < 0x200) // number of vertices added by splits
        read_u32(&r);
    else if (version < 0x202)
        read_varint(&r);
    out->points = version < 0x200 ? read_u32(&r) : read_varint(&r);
    out->faces = version < 0x200 ? read_u32(&r) : read_varint(&r);
    return r.ok;
}

uint64_t draco_claim_bytes(const struct draco_claim *claim)
{
    enum { PER_FACE = 96, PER_POINT = 192 };
    return (uint64_t)claim->faces * PER_FACE + (uint64_t)claim->points * PER_POINT;
}
