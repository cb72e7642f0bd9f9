// compose.h: composites a picture over a background, for formats without alpha.
#ifndef COMPOSE_H
#define COMPOSE_H

#include <lambent/image.h>

// Composes channels over a background: in linear light, unless the numbers are raw.
struct compose {
    double linear[256];   // of a byte
    double from[256];     // for i > 0 the smallest linear number that is rounded to byte i: the value of (i − ½)/255
    double background[3]; // linear
    uint8_t clear[3];     // where alpha is 0
};

void compose_start(struct compose *compose, const lam_save_params *params);

// `count` pixels of four bytes to three.
void compose_row(const struct compose *compose, const uint8_t *rgba, size_t count, uint8_t *rgb);

#endif
