// huffman.h: prefix codes of limited length.
#ifndef HUFFMAN_H
#define HUFFMAN_H

#include <stdint.h>

enum { HUFFMAN_SYMBOLS = 288 }; // the most there can be

// Finds code lengths for symbols that occur counts[i] times: 0 for those that do not occur, else 1 … limit. A
// single used symbol gets length 1. Counts are below 2²³, and 2^limit is not below the number of symbols.
// Only the counts decide, so the code is the same everywhere; equal counts are ranked by symbol.
void huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths);

// The canonical codes for these lengths (RFC 1951, 3.2.2), first bit lowest, as they go into a deflate stream.
void huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes);

#endif
