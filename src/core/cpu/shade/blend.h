// blend.h: blends translucent fragments in order of depth.
#ifndef BLEND_H
#define BLEND_H

#include "coverage.h"
#include "fragments.h"
#include "resolve.h"
#include "samples.h"
#include "translucent_fragments.h"

struct recorder;

// A pixel's fragment to be sorted by depth at one sample. The nearer fragment has the larger rank.
struct layer {
    uint64_t rank;
    uint32_t fragment;
};

// Scratch memory of one thread.
struct blend_scratch {
    uint32_t *order;      // fragment indices in the order of pixels
    uint32_t *start;      // the start of each pixel in `order`, and the end of the last pixel
    struct layer *layers; // the layers of one pixel
};

// Joins the fragments of a tile that belong to the same clipped triangle and the same pixel. Then sorts the tile's
// translucent fragments by pixel. Call this function before the fragments are grouped and shaded.
void sort_layers(const struct sample_pattern *pattern, struct fragments *fragments, struct layer_rows *rows,
                 struct blend_scratch *scratch);

// A rectangle of a tile's pixels, and the tile's visibility buffer.
struct tile_part {
    const struct tile *tile;
    const struct rectangle *area;
    const uint32_t *ids;
};

// Blends the sorted and shaded fragments of a rectangle. Adds the light of the fragments to the sums of the rectangle's
// pixels, and sets the pixels' `transmittance`. Returns how many of these pixels have no opaque fragment. If `recorder`
// is not NULL, it receives the values of the explained pixel.
uint64_t blend_layers(const struct sample_pattern *pattern, const struct fragments *fragments,
                      const struct layer_rows *rows, struct blend_scratch *scratch, const struct tile_part *part,
                      struct pixel_sums *sums, struct recorder *recorder);

// Stores the nearest fragment of each sample in the tile's visibility buffer. This step replaces sorting and blending
// for outputs without colours.
void show_layers(const struct sample_pattern *pattern, const struct fragments *fragments, const struct layer_rows *rows,
                 struct tile_samples *samples);

#endif
