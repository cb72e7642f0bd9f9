// output.h: writes pixels with surface properties instead of colours (lam_output in lambent/device.h).
#ifndef OUTPUT_H
#define OUTPUT_H

#include "coverage.h"
#include "fragments.h"
#include "resolve.h"

// Writes a tile's pixels. For these outputs, this function replaces the function `resolve` of the kernels.
// LAM_OUTPUT_CLIPPED uses sums->unclipped, which contains the tile's pixels row by row.
void output_tile(const struct resolve_target *target, const struct fragments *fragments,
                 const struct tile_samples *samples, struct pixel_sums *sums, const struct tile *tile);

// Sets target->empty_pixel, the value of a pixel without fragments.
void output_empty(struct resolve_target *target);

#endif
