// huffman.h: builds prefix codes of limited length.
#ifndef HUFFMAN_H
#define HUFFMAN_H

#include <stdint.h>

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
