// position_bins.h: collects the corners at the positions from shared_positions.h and sorts them into bins, one for each
// range of positions. This is the second step of visible_normals.h.
#ifndef POSITION_BINS_H
#define POSITION_BINS_H

#include "shared_positions.h"

// Bin r of each thread's lists contains the corners whose position p satisfies p >> shift = r.
struct position_bins {
    struct position_search *search;
    unsigned shift;
    size_t count;
};

// Puts the corners into bins. Returns false if the call was stopped (search->loop) or the probe limit was exceeded.
bool position_bins_fill(struct position_bins *bins, struct position_search *search);

// Returns the number of corners in a bin.
size_t position_bin_corners(const struct position_bins *bins, size_t bin);

// Sorts the corners of a bin by position; the corners of the bin's position i begin at sorted[starts[i]] and end before
// sorted[starts[i+1]].
void position_bin_sort(const struct position_bins *bins, size_t bin, uint32_t *restrict sorted,
                       uint32_t *restrict starts);

#endif
