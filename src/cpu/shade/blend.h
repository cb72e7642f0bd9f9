// blend.h: blends translucent fragments in order of depth.
#ifndef BLEND_H
#define BLEND_H

#include "coverage.h"
#include "fragments.h"
#include "resolve.h"
#include "samples.h"
#include "translucent_fragments.h"

struct recorder;

// A pixel's fragment to be sorted by depth at one sample: the larger rank is nearer.
struct layer {
    uint64_t rank;
    uint32_t fragment;
};

// Scratch memory of one thread.
struct blend_scratch {
    uint32_t *order;      // fragment indices in the order of pixels
    uint32_t *start;      // the start of each pixel in `order`, plus one at the end
    struct layer *layers; // the layers of one pixel
};

// Sorts a tile's translucent fragments by pixel, after joining the fragments of one clipped triangle's parts in each
// pixel. Call it before they are grouped and shaded.
void sort_layers(const struct sample_pattern *pattern, struct fragments *fragments, struct layer_rows *rows,
                 struct blend_scratch *scratch);

// A rectangle of a tile's pixels, and the tile's visibility buffer.
struct tile_part {
    const struct tile *tile;
    const struct rectangle *area;
    const uint32_t *ids;
};

// Blends the sorted and shaded fragments of a part of a tile into the sums and `transmittance` of its pixels. Returns
// how many of the pixels have no opaque fragment. `recorder` is NULL, or receives the numbers of its pixel.
uint64_t blend_layers(const struct sample_pattern *pattern, const struct fragments *fragments,
                      const struct layer_rows *rows, struct blend_scratch *scratch, const struct tile_part *part,
                      struct pixel_sums *sums, struct recorder *recorder);

// Replaces sorting and blending: puts the nearest fragment of each sample into the tile's visibility buffer.
void show_layers(const struct sample_pattern *pattern, const struct fragments *fragments, const struct layer_rows *rows,
                 struct tile_samples *samples);

#endif
