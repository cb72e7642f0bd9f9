// occlusion_pattern.h: the rays of ambient occlusion that every lit point sends.
//
// Directions come from points of a disc below the hemisphere (Malley's method: each then has an equal share
// of the cosine-weighted integral); the disc has the spiral of Vogel (1979), as lights with a size have it
// (light_pattern.h). Every lit point turns the disc by an angle of its own, so that the steps become fine grain. A surface at the distance d occludes by the share
//     w(d) = clamp((radius − d) / (OCCLUSION_FADING radius), 0, 1)
// of its direction: as many of the rays reach as far as d, if their lengths are spread evenly from (1 − OCCLUSION_FADING)
// radius to the whole of it. So a ray is stopped or it is not, and its distance does not matter.
#ifndef OCCLUSION_PATTERN_H
#define OCCLUSION_PATTERN_H

#include <stdint.h>

// The part of the radius in which surfaces occlude less and less.
#define OCCLUSION_FADING 0.4f

enum { OCCLUSION_RAYS_MAX = 1024, OCCLUSION_TURNS = 256 };

// Rays about +z, neighbours in the list pointing in similar directions.
struct occlusion_pattern {
    int count;
    double x[OCCLUSION_RAYS_MAX], y[OCCLUSION_RAYS_MAX], z[OCCLUSION_RAYS_MAX]; // unit
    double length[OCCLUSION_RAYS_MAX];                     // 0…1, from the longest ray to the shortest
    double cosine[OCCLUSION_TURNS], sine[OCCLUSION_TURNS]; // of the turns of occlusion_turn
};

// Returns the turn at a pixel: interleaved gradient noise (Jimenez 2014) in whole numbers, whose neighbours differ as
// much as possible.
static inline uint32_t occlusion_turn(uint32_t x, uint32_t y)
{
    uint32_t part = x * 0x112e0be8u + y * 0x017e8cd9u;       // fraction of 0.06711056 x + 0.00583715 y
    return (uint32_t)((uint64_t)part * 3472289 >> 16) >> 24; // … of 52.9829189 times that
}

void occlusion_pattern_fill(struct occlusion_pattern *pattern, int count);

#endif
