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

#endif
