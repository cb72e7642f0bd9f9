// translucent_fragments.h: additional rows of translucent fragments, beside those in fragments.h.
#ifndef TRANSLUCENT_FRAGMENTS_H
#define TRANSLUCENT_FRAGMENTS_H

#include <stdbool.h>
#include <stdint.h>

struct layer_rows {
    uint16_t *samples; // for each fragment, a bit for each sample that shows it
    float *keys;       // for each fragment, a depth key for each sample
    // Some fragments belong to parts of clipped triangles; two parts of one triangle may share a pixel.
    bool clipped;
    bool masked; // some samples were omitted because of the opacity of a surface
    // Transmitting triangles were omitted (raster_frame.without_glass); the listing sets it and never clears it.
    bool glass;
};

#endif
