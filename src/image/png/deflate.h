// deflate.h: rows of filtered pixels become a deflate block (RFC 1951).
//
// What is left of a lit picture after a row filter is two things: runs of one pixel (the background, flat
// areas) and noise of a few small numbers. There are two ways to look for matches, chosen for each strip by
// the caller:
//   runs   only the pixel before, repeated at least twice. Coloured noise is held best by Huffman codes:
//   matches
//          further back make it larger (measured: 5–20 %).
//   pairs  also the last place where the same two pixels stood. In a grey picture the three channels say the
//   same
//          thing, which codes of single bytes cannot use; a match tells it once (measured: 20 % smaller).
// No match leaves the strip, so a strip stands alone. The codes are made for each strip from its own counts. Everything
// between the filter and the bits is a flat list of tokens, and the loops over it (and the search for runs) have no
// branch that depends on the picture: a wrongly foreseen one costs as much as writing two pixels.
#ifndef DEFLATE_H
#define DEFLATE_H

#include "arena.h"

#include <stdint.h>

enum {
    DEFLATE_SHORTEST = 3, // bytes of a match
    DEFLATE_LONGEST = 258,
    DEFLATE_FARTHEST = 32768, // bytes back
    // What a quarter of a token can be: a byte; a match's length of 3 … 258 bytes; the symbol of its
    // distance; n ≤ 8 bits as they are, of value v, as DEFLATE_BITS + 2ⁿ + v.
    DEFLATE_MATCH = 256, // + length − 3
    DEFLATE_DISTANCE = DEFLATE_MATCH + 256,
    DEFLATE_BITS = DEFLATE_DISTANCE + 30,
    DEFLATE_NOTHING = DEFLATE_BITS + 1, // no bits
    DEFLATE_KINDS = DEFLATE_BITS + 512,
};

// The bytes of a pixel; or a match: length, distance, the distance's further bits low and high; or a row's filter.
struct token {
    uint16_t kind[4];
};

enum { DEFLATE_HASH_BITS = 12 };

// The scratch for one strip at a time, of at most `rows` rows of `width` pixels.
struct deflate {
    int width, bytes_per_pixel;
    uint32_t *row;   // where the next row goes: a word a pixel, with 4 words of room before it and 16 behind
    uint32_t *words; // the first row
    size_t stride;   // from row to row
    uint8_t filter;
    bool pairs;
    uint32_t y;            // rows taken
    uint32_t *last_places; // with pairs: for each hash of two pixels y << 16 | x of the last ones
    struct token *tokens, *end;
    // How often each kind occurs in each quarter, even and odd tokens apart.
    uint32_t counts[2][4][DEFLATE_KINDS];
};

// Memory comes from the arena; false: none left. deflate_scratch: how much is asked for, about.
bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel);
size_t deflate_scratch(int width, int rows);

// Starts a strip whose rows have one filter. Then, for each row in order, the caller puts its pixels at
// deflate->row, those before `first` and from `end` on being zero, and calls deflate_row, which moves
// deflate->row on. With bytes_per_pixel 3 each word's highest
// byte must be zero and does not enter the stream. The words beside the row are overwritten.
void deflate_start(struct deflate *deflate, uint8_t filter, bool pairs);
void deflate_row(struct deflate *deflate, int first, int end);

// Writes the rows taken, each with its filter's byte in front, as one or more blocks that are not the last, then an
// empty stored block, which ends on a byte boundary (what zlib calls a sync flush). Returns the bytes written.
size_t deflate_write(const struct deflate *deflate, uint8_t *out);

// The most bytes that deflate_write writes or touches.
size_t deflate_room(int width, int rows, int bytes_per_pixel);

#endif
