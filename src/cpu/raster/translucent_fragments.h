// translucent_fragments.h: what translucent fragments have beside the rows of fragments.h.
#ifndef TRANSLUCENT_FRAGMENTS_H
#define TRANSLUCENT_FRAGMENTS_H

#include <stdbool.h>
#include <stdint.h>

struct layer_rows {
    uint16_t *samples; // of each fragment: a bit for each sample that shows it
    float *keys;       // of each fragment: a depth key for each sample
    // Some fragments belong to pieces of clipped triangles; two pieces of one triangle may share a pixel.
    bool clipped;
    bool masked; // some samples were left out by the opacity of a surface
    bool
        glass; // triangles that transmit were left out (raster_frame.without_glass); set, never cleared, by the listing
};

#endif
