// deflate.h: converts rows of filtered pixels to deflate blocks (RFC 1951).
//
// After a row filter, a lit picture consists of runs of equal pixels (the background, flat areas) and noise of a few
// small numbers. There are two methods of finding matches:
//  runs     only the previous pixel, repeated at least twice. Coloured noise is smallest as Huffman codes; matches over
//           a distance make the file larger (measured: 5–20 %).
//  matches  also the last position of the same few pixels. The caller uses this method for grey pictures and for grey
//           strips of coloured pictures. In such strips, the three channels are equal, which codes of single bytes
//           cannot exploit (measured: 20 % smaller).
// Matches never leave the strip, so each strip can be encoded separately, with Huffman codes from its own counts.
// The filtered pixels are first converted to a flat list of tokens. The tokens are then converted to bits. The loops
// over this list, and the search for runs, contain no branch that depends on the picture, because a misprediction takes
// as long as writing two pixels.
#ifndef DEFLATE_H
#define DEFLATE_H

#include "arena.h"

#include <stdint.h>
#include <string.h>

enum {
    DEFLATE_SHORTEST = 3, // the shortest match in bytes
    DEFLATE_LONGEST = 258,
    DEFLATE_FARTHEST = 32768, // the largest distance in bytes
    DEFLATE_PACKED = 2,       // rows of pixels of at most two bytes are packed
    // A quarter of a token is one of these: a byte; the length of a match, 3 … 258 bytes; the symbol of a match's
    // distance; or n ≤ 8 raw bits with the value v, represented as DEFLATE_BITS + 2ⁿ + v.
    DEFLATE_MATCH = 256, // + length − 3
    DEFLATE_DISTANCE = DEFLATE_MATCH + 256,
    DEFLATE_BITS = DEFLATE_DISTANCE + 30,
    DEFLATE_NOTHING = DEFLATE_BITS + 1, // no bits
    DEFLATE_KINDS = DEFLATE_BITS + 512,
};

// A token is up to four bytes of pixels, or a match, or the filter of a row. A match consists of its length, its
// distance, and the low and high extra bits of the distance.
struct token {
    uint16_t kind[4];
};

enum { DEFLATE_HASH_BITS = 12 };

// The state of the strip that is being encoded. A strip has at most `rows` rows of `width` pixels.
struct deflate {
    int width, bytes_per_pixel;
    uint32_t *row;   // the next row: one word per pixel, with 4 words of padding before the row and 16 after it
    uint32_t *words; // the first row
    size_t stride;   // the distance between rows in words; 0 if the rows are packed
    uint8_t *stream; // the added rows as bytes, each after its filter, if the rows are packed; otherwise NULL
    uint8_t filter;
    bool matches;
    uint32_t y; // number of rows added
    // With matches: for each hash of pixels, the last position with this hash, as y << 16 | x, or as an offset in
    // `stream`.
    uint32_t *last_positions;
    struct token *tokens, *end;
    // The number of occurrences of each kind in each quarter, for even and odd tokens separately.
    uint32_t counts[2][4][DEFLATE_KINDS];
};

// Allocates the arrays from the arena. Returns false if memory runs out. deflate_scratch returns the approximate number
// of bytes that these arrays need.
bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel);
size_t deflate_scratch(int width, int rows);

// Starts a strip whose rows all have the same filter. For each row in order, the caller then writes the row's pixels to
// deflate->row and calls deflate_row, which advances deflate->row. Pixels before `first`, and pixels at and after
// `end`, must be zero. In each word, the bytes above the lowest bytes_per_pixel must be zero; these bytes are not part
// of the stream. The padding is overwritten. Pixels of one or two bytes always use matches.
void deflate_start(struct deflate *deflate, uint8_t filter, bool matches);
void deflate_row(struct deflate *deflate, int first, int end);

// Writes the added rows, each after its filter byte, as one or more blocks. No block is marked as the last. At the end,
// writes an empty stored block, so that the output ends on a byte boundary (like zlib's sync flush). Returns the number
// of bytes.
size_t deflate_write(const struct deflate *deflate, uint8_t *out);

// Returns the maximum number of bytes that deflate_write writes.
size_t deflate_capacity(int width, int rows, int bytes_per_pixel);

// --- builds a block's prefix codes (RFC 1951, 3.2.7) from counts, and writes them as bits.

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

// --- builds prefix codes of limited length.

enum { HUFFMAN_SYMBOLS = 288 }; // the largest number of symbols

// Finds the code lengths of all symbols; symbol i occurs counts[i] times. The length is 0 for a symbol that does not
// occur, otherwise 1 … limit. If only one symbol occurs, the length of its code is 1. Counts must be below 2²³, and
// 2^limit must be at least the number of symbols. The code depends only on the counts; symbols with equal counts are
// ordered by index.
void huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths);

// Computes the canonical codes for these lengths (RFC 1951, 3.2.2). The first bit of a code is the lowest, as in
// deflate streams.
void huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes);

#endif
