// deflate.h: converts rows of filtered pixels to deflate blocks (RFC 1951).
//
// After a row filter, a lit picture consists of runs of one pixel (the background, flat areas) and noise of a few small
// numbers. There are two ways to look for matches:
//   runs     only the pixel before, repeated at least twice. Coloured noise becomes smallest as Huffman codes: matches
//            over a distance make it larger (measured: 5–20 %).
//   matches  also the last position of the same few pixels. The caller takes this way for grey pictures and for grey
//            strips of coloured ones, where the three channels repeat each other, which codes of single bytes cannot
//            use (measured: 20 % smaller).
// No match leaves the strip, so a strip can be encoded by itself, with Huffman codes from its own counts. Between the
// filter and the bits there is a flat list of tokens. The loops over it, and the search for runs, have no branch that
// depends on the picture: a mispredicted one costs as much as writing two pixels.
#ifndef DEFLATE_H
#define DEFLATE_H

#include "arena.h"

#include <stdint.h>

enum {
    DEFLATE_SHORTEST = 3, // bytes of a match
    DEFLATE_LONGEST = 258,
    DEFLATE_FARTHEST = 32768, // bytes back
    // A quarter of a token is one of these: a byte; a match's length of 3 … 258 bytes; the symbol of its distance; n ≤
    // 8 raw bits of value v, as DEFLATE_BITS + 2ⁿ + v.
    DEFLATE_MATCH = 256, // + length − 3
    DEFLATE_DISTANCE = DEFLATE_MATCH + 256,
    DEFLATE_BITS = DEFLATE_DISTANCE + 30,
    DEFLATE_NOTHING = DEFLATE_BITS + 1, // no bits
    DEFLATE_KINDS = DEFLATE_BITS + 512,
};

// Up to four bytes of pixels; or a match: its length, its distance, the distance's extra bits low and high; or a row's
// filter.
struct token {
    uint16_t kind[4];
};

enum { DEFLATE_HASH_BITS = 12 };

// The state of one strip at a time, of at most `rows` rows of `width` pixels.
struct deflate {
    int width, bytes_per_pixel;
    uint32_t *row;   // where the next row goes: a word a pixel, with 4 words of padding before it and 16 after it
    uint32_t *words; // the first row
    size_t stride;   // from row to row
    uint8_t filter;
    bool matches;
    uint32_t y;               // rows taken
    uint32_t *last_positions; // with matches: for each hash of some pixels, y << 16 | x of the last ones
    struct token *tokens, *end;
    // How often each kind occurs in each quarter, even and odd tokens apart.
    uint32_t counts[2][4][DEFLATE_KINDS];
};

// Allocates from the arena; false: out of memory. deflate_scratch: about how many bytes that takes.
bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel);
size_t deflate_scratch(int width, int rows);

// Starts a strip whose rows have one filter. Then, for each row in order, the caller writes its pixels at deflate->row,
// those before `first` and from `end` on being zero, and calls deflate_row, which advances deflate->row. The bytes of a
// word above its bytes_per_pixel must be zero; they are no part of the stream. The padding is overwritten. Pixels of
// one or two bytes always have matches.
void deflate_start(struct deflate *deflate, uint8_t filter, bool matches);
void deflate_row(struct deflate *deflate, int first, int end);

// Writes the rows taken, each after its filter byte, as one or more blocks that are not the last, then an empty stored
// block, which ends on a byte boundary (zlib's sync flush). Returns the number of bytes.
size_t deflate_write(const struct deflate *deflate, uint8_t *out);

// Returns the maximum number of bytes that deflate_write touches.
size_t deflate_capacity(int width, int rows, int bytes_per_pixel);

#endif
