// position_bins.h: the corners at the positions that are seen, by ranges of positions.
#ifndef POSITION_BINS_H
#define POSITION_BINS_H

#include "shared_positions.h"

// Puts the corners into bins, one for each of s->ranges. False: it ended early (s->halt), or the table does
// not serve (s->crowded): weld_all, and then again.
bool bin_corners(struct seeing *s);

// How many corners a range has.
size_t corners_in_range(const struct seeing *s, size_t range);

// Puts the corners of a range in order by position, in `sorted`; `starts` tells for each of its positions,
// and one more, where they begin.
void sort_range(const struct seeing *s, size_t range, uint32_t *restrict sorted, uint32_t *restrict starts);

#endif
