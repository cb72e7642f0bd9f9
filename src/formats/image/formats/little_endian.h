// little_endian.h: reads the numbers of a file that stores the lowest byte first.
#ifndef LITTLE_ENDIAN_H
#define LITTLE_ENDIAN_H

#include <stdint.h>

static inline uint32_t u16_at(const uint8_t *at) { return (uint32_t)at[0] | (uint32_t)at[1] << 8; }
static inline uint32_t u32_at(const uint8_t *at) { return u16_at(at) | u16_at(at + 2) << 16; }

// Converts 5 bits, 0…31, to a byte: floor(255·v/31 + ½).
static inline uint8_t byte_of_5_bits(uint32_t value) { return (uint8_t)(((value & 31) * 255 * 2 + 31) / 62); }

#endif
