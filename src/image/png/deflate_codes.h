// deflate_codes.h: a block's prefix codes (RFC 1951, 3.2.7): made from counts, told, and the bits they become.
#ifndef DEFLATE_CODES_H
#define DEFLATE_CODES_H

#include "deflate.h"

#include <string.h>

enum {
    LITERALS = 286, // bytes 0…255, end of block, lengths 257…285
    END_OF_BLOCK = 256,
    FIRST_LENGTH = 257,
    DISTANCES = 30,
    CODE_LIMIT = 14, // a token in one 64-bit step: four codes, 4·14 bits, and the 7 bits still waiting
    STORED_MOST = 65535,
};

// Bits waiting to become bytes, the first lowest. After put() fewer than 8 wait.
struct bits {
    uint8_t *at;
    uint64_t waiting;
    unsigned count;
};

static inline __attribute__((always_inline)) void put(struct bits *bits, uint64_t value, unsigned count)
{
    bits->waiting |= value << bits->count;
    bits->count += count;
    memcpy(bits->at, &bits->waiting, 8);
    bits->at += bits->count >> 3;
    bits->waiting >>= bits->count & 56;
    bits->count &= 7;
}

// Ends on a byte boundary with an empty stored block.
static inline uint8_t *put_boundary(struct bits *bits)
{
    put(bits, 0, 3);
    if (bits->count)
        put(bits, 0, 8 - bits->count);
    put(bits, 0xFFFF0000u, 32);
    return bits->at;
}

// A block's two codes and how they are told.
struct codes {
    uint8_t length[LITERALS], distance_length[DISTANCES];
    uint16_t code[LITERALS], distance_code[DISTANCES];
    unsigned literals, distances;       // how many lengths are told
    uint8_t told[LITERALS + DISTANCES]; // the lengths' own symbols 0…18, in order …
    uint8_t more[LITERALS + DISTANCES]; // … and what follows each in extra bits
    unsigned told_count;
    uint8_t told_length[19];
    uint16_t told_code[19];
    unsigned told_lengths; // how many of told_length, in the format's order
    uint64_t bits;         // of the whole block
};

// The symbol and the number of extra bits of a match of 3 … 258 bytes.
unsigned length_symbol(unsigned length, unsigned *extra);

// Further bits of a distance symbol.
static inline unsigned distance_extra(int symbol) { return symbol < 4 ? 0 : (unsigned)symbol / 2 - 1; }

// Makes the codes of a block in which symbols occur so often, the block's end once, with `extra_bits` of
// lengths in all; those of distances are added here.
void codes_make(struct codes *codes, const uint32_t counts[LITERALS], const uint32_t distance_counts[DISTANCES],
                uint64_t extra_bits);

// Begins a block that is not the last.
void put_codes(struct bits *bits, const struct codes *codes);

#endif
