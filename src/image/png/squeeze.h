// squeeze.h: bytes become deflate blocks (RFC 1951) that are as small as a second or two of work makes them.
//
// All matches within 32 KiB are looked for, to some depth, and the cheapest way through each block is found
// by dynamic programming: prices come from the codes of the way before, and ways are found anew until they
// get no shorter. Everything is in whole numbers, so the bytes are the same everywhere.
#ifndef SQUEEZE_H
#define SQUEEZE_H

#include "arena.h"

#include <stdint.h>

enum { SQUEEZE_WINDOW = 32768 }; // how far a match may reach back

struct squeeze;

// Memory for one thread's work, about 8 MB. NULL: the arena has none left.
struct squeeze *squeeze_make(struct arena *arena);

// Compresses bytes[before] … bytes[before + size − 1]; the reader knows the `before` bytes in front, of which
// the last SQUEEZE_WINDOW are made use of. What stands `row` bytes before a place is often the same. Writes
// blocks that are not the last, then an empty stored block, which ends on a byte boundary. Returns the bytes
// written. before + size < 2³¹.
size_t squeeze(struct squeeze *squeeze, const uint8_t *bytes, size_t before, size_t size, size_t row, uint8_t *out);

// The most bytes that squeeze writes or touches.
size_t squeeze_room(size_t size);

// About how many bits `size` bytes will take, found quickly; to compare ways of filtering.
uint64_t squeeze_estimate(struct squeeze *squeeze, const uint8_t *bytes, size_t size, size_t row);

#endif
