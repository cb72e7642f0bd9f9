// deflate.h: rows of filtered pixels become a deflate block (RFC 1951).
//
// What is left of a lit picture after a row filter is two things: runs of one pixel (the background, flat
// areas) and noise of a few small numbers, which Huffman codes hold well and which dictionary matches only
// make larger (measured: a hash of pixel pairs costs 5–10 % more bytes on smooth shading than none). So the
// only match sought is the pixel before, repeated at least twice: one distance, no search, no window, and a
// strip of rows stands alone. The codes are made for each strip from its own counts. Everything between the
// filter and the bits is a flat list of tokens, and the loops over it have no branch that depends on the
// picture: a wrongly foreseen one costs as much as writing two pixels.
#ifndef DEFLATE_H
#define DEFLATE_H

#include "arena.h"

#include <stdint.h>

enum {
    DEFLATE_SHORTEST = 3, // bytes of a match
    DEFLATE_LONGEST = 258,
    // What a quarter of a token can be: a byte; a match of 3 … 258 bytes; nothing.
    DEFLATE_MATCH = 256, // + length − 3
    DEFLATE_NOTHING = DEFLATE_MATCH + 256,
    DEFLATE_KINDS = DEFLATE_NOTHING + 1,
};

// The bytes of a pixel, or a match or a row's filter and nothing more.
struct token {
    uint16_t kind[4];
};

// The scratch for one strip at a time, of at most `rows` rows of `width` pixels.
struct deflate {
    int width, bytes_per_pixel;
    uint32_t *row; // one row of pixels, a word each, with 4 words of room before it and 16 behind
    struct token *tokens, *end;
    // How often each kind occurs in each quarter, even and odd tokens apart.
    uint32_t counts[2][4][DEFLATE_KINDS];
};

// Memory comes from the arena; false: none left. deflate_scratch: how much is asked for, about.
bool deflate_make(struct deflate *deflate, struct arena *arena, int width, int rows, int bytes_per_pixel);
size_t deflate_scratch(int width, int rows);

// Starts a strip. Then, for each row in order, the caller puts its pixels into deflate->row and calls
// deflate_row. With bytes_per_pixel 3 each word's highest byte must be zero and does not enter the stream.
// The words beside the row are overwritten.
void deflate_start(struct deflate *deflate);
void deflate_row(struct deflate *deflate, uint8_t filter);

// Writes the `rows` rows taken, each with its filter's byte in front, as one or more blocks that are not the
// last, then an empty stored block, which ends on a byte boundary (what zlib calls a sync flush). Returns the
// bytes written.
size_t deflate_write(struct deflate *deflate, size_t rows, uint8_t *out);

// The most bytes that deflate_write writes or touches.
size_t deflate_room(int width, int rows, int bytes_per_pixel);

#endif
