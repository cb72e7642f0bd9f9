// coverage.h: the visibility buffer of one tile.
#ifndef COVERAGE_H
#define COVERAGE_H

#include "tile.h"

// The nearest opaque triangle of each sample, stored in cells (tile.h).
struct tile_samples {
    float *keys;                    // depth keys; larger is nearer, and −1 means NOTHING
    uint32_t *ids;                  // triangle number with BACK_SIDE, or NOTHING
    int32_t *counts;                // number of triangles that cover the sample; NULL except for LAM_OUTPUT_OVERDRAW
    uint32_t translucent_triangles; // the number of translucent triangles in the tile's bins
};

#endif
