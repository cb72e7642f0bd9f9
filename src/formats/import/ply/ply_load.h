// ply_load.h: loads a number of any type, byte order and alignment from a binary PLY file.
#ifndef PLY_LOAD_H
#define PLY_LOAD_H

#include "ply.h"

#include <string.h>

static inline uint16_t ply_load_16(const uint8_t *at, bool swapped)
{
    uint16_t bits;
    memcpy(&bits, at, sizeof bits);
    return swapped ? __builtin_bswap16(bits) : bits;
}

static inline uint32_t ply_load_32(const uint8_t *at, bool swapped)
{
    uint32_t bits;
    memcpy(&bits, at, sizeof bits);
    return swapped ? __builtin_bswap32(bits) : bits;
}

static inline double ply_load_f64(const uint8_t *at, bool swapped)
{
    uint64_t bits;
    memcpy(&bits, at, sizeof bits);
    bits = swapped ? __builtin_bswap64(bits) : bits;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline float ply_load_f32(const uint8_t *at, bool swapped)
{
    uint32_t bits = ply_load_32(at, swapped);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// Loads an integer of any type.
static inline int64_t ply_load_integer(const uint8_t *at, enum ply_type type, bool swapped)
{
    switch (type) {
    case PLY_I8:
        return (int8_t)*at;
    case PLY_U8:
        return *at;
    case PLY_I16:
        return (int16_t)ply_load_16(at, swapped);
    case PLY_U16:
        return ply_load_16(at, swapped);
    case PLY_I32:
        return (int32_t)ply_load_32(at, swapped);
    default:
        return ply_load_32(at, swapped);
    }
}

// Loads an integer or a floating-point number of any type, without rounding.
static inline double ply_load_double(const uint8_t *at, enum ply_type type, bool swapped)
{
    if (type == PLY_F32)
        return (double)ply_load_f32(at, swapped);
    if (type == PLY_F64)
        return ply_load_f64(at, swapped);
    return (double)ply_load_integer(at, type, swapped);
}

#endif
