// translucent_fragments.h: rows for translucent fragments, in addition to the rows in fragments.h.
#ifndef TRANSLUCENT_FRAGMENTS_H
#define TRANSLUCENT_FRAGMENTS_H

#include <stdbool.h>
#include <stdint.h>

struct layer_rows {
    uint16_t *samples; // for each fragment, bits of the samples that show the fragment
    float *keys;       // for each fragment, a depth key for each sample
    // Some triangles were clipped into several triangles. Two of these triangles may share a pixel.
    bool clipped;
    bool masked; // some samples were removed because of the opacity of a surface
    // Triangles that transmit light were omitted (raster_frame.without_glass). translucent_fragments sets this flag and
    // never clears it.
    bool glass;
};

#endif
