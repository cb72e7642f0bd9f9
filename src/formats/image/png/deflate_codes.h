// deflate_codes.h: builds a block's prefix codes (RFC 1951, 3.2.7) from counts, and writes them as bits.
#ifndef DEFLATE_CODES_H
#define DEFLATE_CODES_H

#include "deflate.h"

#include <string.h>

enum {
    LITERALS = 286, // symbols: bytes 0…255, the end of the block, and lengths 257…285
    END_OF_BLOCK = 256,
    FIRST_LENGTH = 257,
    DISTANCES = 30,
    CODE_LENGTHS = 19,
    CODE_LIMIT = 14,    // a token is written in one 64-bit step: four codes (4·14 bits) and at most 7 pending bits
    MAX_STORED = 65535, // bytes per stored block
};

// A bit writer. The bits of an incomplete byte are pending; the first bit is the lowest. After put(), fewer than 8 bits
// are pending.
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

// Pads to a byte boundary with an empty stored block.
static inline uint8_t *put_boundary(struct bits *bits)
{
    put(bits, 0, 3);
    if (bits->count)
        put(bits, 0, 8 - bits->count);
    put(bits, 0xFFFF0000u, 32);
    return bits->at;
}

// A block's two codes, and the encoded form of their code lengths.
struct codes {
    uint8_t length[LITERALS], distance_length[DISTANCES];
    uint16_t code[LITERALS], distance_code[DISTANCES];
    unsigned literals, distances; // number of written code lengths

    // The code lengths as symbols 0…18 of the code length code, and the values of their extra bits.
    uint8_t length_symbols[LITERALS + DISTANCES], length_extra[LITERALS + DISTANCES];
    unsigned length_symbol_count;

    // The code length code.
    uint8_t code_length_length[CODE_LENGTHS];
    uint16_t code_length_code[CODE_LENGTHS];
    unsigned code_lengths; // number of written code_length_length entries, in the format's order

    uint64_t bits; // the size of the whole block
};

// Returns the symbol of a match of 3 … 258 bytes, and the number of its extra bits.
unsigned length_symbol(unsigned length, unsigned *extra);

// Returns the number of extra bits of a distance symbol.
static inline unsigned distance_extra(int symbol) { return symbol < 4 ? 0 : (unsigned)symbol / 2 - 1; }

// Makes the codes of a block from the number of occurrences of each symbol. The symbol for the end of the block occurs
// once. `extra_bits` is the number of extra bits of all lengths; this function adds the extra bits of the distances.
void codes_make(struct codes *codes, const uint32_t counts[LITERALS], const uint32_t distance_counts[DISTANCES],
                uint64_t extra_bits);

// Writes the header of a block with its codes. The block is not marked as the last.
void put_codes(struct bits *bits, const struct codes *codes);

#endif
