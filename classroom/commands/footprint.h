// footprint.h: draws the area that a pixel covers in a texture (explain --figure footprint).
#ifndef FOOTPRINT_H
#define FOOTPRINT_H

#include <jansson.h>

#include "drawing.h"

// Draws a panel of 320 × 190 units below `top`, the middle of its upper edge. `map` is an element of "maps" of
// `lambent explain --json`.
bool draw_footprint(const json_t *map, struct point top, double unit, struct drawing *drawing, lam_error *error);

#endif
