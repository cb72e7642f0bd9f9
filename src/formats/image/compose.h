// compose.h: composites a picture over a background, for formats without alpha.
#ifndef COMPOSE_H
#define COMPOSE_H

#include <lambent/image.h>

// Tables for compositing a picture over a background, in linear light unless the picture's values are raw.
struct compose {
    double linear[256]; // the linear value of each byte
    // For i > 0, the smallest linear value that rounds to byte i: the linear value of (i − ½)/255.
    double from[256];
    double background[3]; // linear
    uint8_t clear[3];     // the result if alpha is 0
};

void compose_start(struct compose *compose, const lam_save_params *params);

// Composites `count` pixels of four bytes (RGBA) over the background, and writes pixels of three bytes (RGB).
void compose_row(const struct compose *compose, const uint8_t *rgba, size_t count, uint8_t *rgb);

#endif
