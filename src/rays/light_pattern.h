// light_pattern.h: the points of a light with a size that shadow rays aim at.
//
// The points lie on a disc across the way to the light: a ball looks like its disc. They follow the spiral of Vogel (1979),
// each with an equal share of the disc: point i of N at the radius √((i + ½)/N), turned by i golden angles. Every lit point
// turns the disc by an angle of its own, one of LIGHT_TURNS, so that the steps of N shares become fine grain and not bands.
#ifndef LIGHT_PATTERN_H
#define LIGHT_PATTERN_H

#include <stdint.h>

enum { LIGHT_TURNS = 256, LIGHT_POINTS_MAX = 256 };

struct light_pattern {
    int count;
    double x[LIGHT_POINTS_MAX], y[LIGHT_POINTS_MAX]; // on the disc of radius 1
    double cosine[LIGHT_TURNS], sine[LIGHT_TURNS];
};

void light_pattern_fill(struct light_pattern *pattern, int count);

// The turn at a pixel: interleaved gradient noise (Jimenez 2014) in whole numbers, whose neighbours differ as much as
// possible. Vertices take their element as x.
static inline uint32_t light_turn(uint32_t x, uint32_t y)
{
    uint32_t part = x * 0x112e0be8u + y * 0x017e8cd9u;       // fraction of 0.06711056 x + 0.00583715 y
    return (uint32_t)((uint64_t)part * 3472289 >> 16) >> 24; // … of 52.9829189 times that
}

#endif
