// huffman.h: builds prefix codes of limited length.
#ifndef HUFFMAN_H
#define HUFFMAN_H

#include <stdint.h>

enum { HUFFMAN_SYMBOLS = 288 }; // the largest number of symbols

// Finds code lengths for symbols that occur counts[i] times: 0 for a symbol that does not occur, else 1 … limit. A
// single symbol gets length 1. Counts are below 2²³, and 2^limit is at least the number of symbols. The code depends
// only on the counts; symbols with equal counts are ordered by index.
void huffman_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths);

// Computes the canonical codes for these lengths (RFC 1951, 3.2.2), first bit lowest, as deflate streams store them.
void huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes);

#endif
